// Sensors: shapes that only tell who is in them.
#pragma once

namespace brickfall {

class Diary;
class Proximity;
class Registry;

// At the poses after a step. Costs nothing where there are no sensors.
void sense(const Registry& registry, const Proximity& proximity, Diary& diary);

}  // namespace brickfall
