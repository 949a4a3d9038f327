#version 450

// Views in the thesis's look.

#define SHOWN as_look
#include "wheatstone/multiview/finish_views.glsl"
