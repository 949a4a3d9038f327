#version 450

// Gathers splats of mass in colours of their own.

#define CHANNELS 3
#define OF_MASS true
#include "wheatstone/multiview/gather_splats.glsl"
