// The whole of brickfall-render: from options to files.
#pragma once
#include "brickfall/take.h"
#include "render/options.h"
#include "render/painter.h"

namespace brickfall::render {

// The exit code of the process; mistakes are on standard error.
int render(const RenderOptions& options);

// The parts that are decided before anything is drawn.
// The camera of that name or number (from 1); empty: the first. A take without any gets one that sees all of its bodies.
Result<Camera> chooseCamera(const TakeReader& take, const std::string& wanted);
// The number of the body that --follow asks for, by its name.
Result<std::uint32_t> chooseBody(const TakeReader& take, const std::string& wanted);
// From the front left of what the camera looks at where its path begins, as a photographer would have it: the same for every part of a
// film.
Sky skyFor(const Camera& camera, const std::optional<Sun>& sun);
// The moments at which the shutter opens, s. The take may begin late: nothing is shown of the time before it.
Result<std::vector<double>> momentsOf(const TakeReader& take, const RenderOptions& options, OutputKind kind);
// Everything that the pictures depend on, a line each.
std::string settingsText(const RenderOptions& options, const std::string& source, std::uint64_t fingerprint,
                         int samples);

}  // namespace brickfall::render
