#version 450

// Gathers splats of the thesis's look.

#define CHANNELS 3
#define KERNEL 0
#include "wheatstone/multiview/gather_splats.glsl"
