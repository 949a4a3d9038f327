#version 450

// Gathers splats of mass in colours of their own.

#define CHANNELS 3
#define KERNEL 1
#include "wheatstone/multiview/gather_splats.glsl"
