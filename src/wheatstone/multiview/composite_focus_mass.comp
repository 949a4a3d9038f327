#version 450

// Depth planes of mass: light, and light times a second number, in focus.

#define CHANNELS 2
#include "wheatstone/multiview/composite_in_focus.glsl"
