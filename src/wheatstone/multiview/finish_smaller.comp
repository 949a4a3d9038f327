#version 450

// Smaller pictures are put together, and stay light.

#define SHOWN stays_light
#include "wheatstone/multiview/finish_views.glsl"
