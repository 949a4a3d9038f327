#version 450

// Depth planes of three channels of light, in focus.

#define CHANNELS 3
#include "wheatstone/multiview/composite_in_focus.glsl"
