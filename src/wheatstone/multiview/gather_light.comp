#version 450

// Gathers splats of the thesis's look.

#define CHANNELS 3
#define OF_MASS false
#include "wheatstone/multiview/gather_splats.glsl"
