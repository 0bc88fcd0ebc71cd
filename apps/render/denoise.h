// Takes the noise out of the light from the sky: a mean over neighbours that lie on the same surface and are, within what their noise
// allows, equally lit. The more samples there were, the less is changed: with very many little.
#pragma once
#include "render/camera_rays.h"
#include "render/picture.h"

namespace brickfall::render {

void denoise(Picture& picture, const CameraRays& rays, int threads);
// What the camera gets from each pixel, from the parts of a picture.
std::vector<Rgb> developed(const Picture& picture);

}  // namespace brickfall::render
