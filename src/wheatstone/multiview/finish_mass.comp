#version 450

// Views of mass, or of a quantity's mean.

#define SHOWN as_mass
#include "wheatstone/multiview/finish_views.glsl"
