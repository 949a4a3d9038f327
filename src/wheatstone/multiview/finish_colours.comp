#version 450

// Views of mass in colours of its own.

#define SHOWN as_colours
#include "wheatstone/multiview/finish_views.glsl"
