#version 450

// Gathers splats of mass: light, and light times a second number.

#define CHANNELS 2
#define OF_MASS true
#include "wheatstone/multiview/gather_splats.glsl"
