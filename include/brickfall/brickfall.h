// The engine's whole public API.
#pragma once
#include "brickfall/body.h"
#include "brickfall/broad_phase.h"
#include "brickfall/debug_draw.h"
#include "brickfall/events.h"
#include "brickfall/ids.h"
#include "brickfall/limits.h"
#include "brickfall/math.h"
#include "brickfall/result.h"
#include "brickfall/shapes.h"
#include "brickfall/step_report.h"
#include "brickfall/step_trace.h"
#include "brickfall/world.h"
