// The light of window, page and film, which light.glsl has for all three: here as functions of C++.
#pragma once
#include "appearance/colour.h"

namespace brickfall::appearance {

// Irradiance of a surface that faces the sun.
Rgb sunLight();
// Towards the sun, unit: over the left shoulder of a camera. `back`: from what it looks at to the camera, of any length.
Vec3f sunOver(Vec3f back);
// Azimuth from +z towards +x, elevation above the horizon, degrees.
Vec3f sunDirection(double azimuthDegrees, double elevationDegrees);
// Radiance from a direction (unit) without the sun's disc. From below the horizon: what bare ground sends back.
Rgb skyLight(Vec3f towards, Vec3f sun);
// Radiance of a white matt surface in the open by sky and ground alone.
Rgb ambientLight(Vec3f normal, Vec3f sun);
// Of ground at a distance, m: share of the light of the horizon in what is seen, and that light.
float hazeShare(float away);
Rgb hazeLight(Vec3f towards, Vec3f sun);
// What the joints of a floor leave of its colour. Place, and width of a pixel along x and z: m.
float floorShade(Vec3f place, Vec3f width);
// What is left of a brick's colour so far from the edge of its face. Both m.
float edgeShade(float toEdge, float pixel);
// From light to what a screen shows, linear still: 0 stays 0, all light stays below 1 and rises with what comes in. Bright parts are
// pressed together instead of cut off, and lose colour as film does. All pictures have one exposure, a factor.
Rgb toneMapped(Rgb light, float exposure);
float usualExposure();
// The same with that exposure.
Rgb shownAs(Rgb light);

}  // namespace brickfall::appearance
