// Random pairs of every family against the slow method, as many as asked for; shared by the tests and the long run.
#pragma once

namespace brickfall::test {

// `count` pairs over all families, each looked at in double and in float.
void sweepOneInstant(int count);
void sweepFirstContact(int count);

}  // namespace brickfall::test
