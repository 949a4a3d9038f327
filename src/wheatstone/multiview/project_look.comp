#version 450

// Particles in the thesis's look are projected.

#define KIND_OF_LIGHT 0
#include "wheatstone/multiview/project_splats.glsl"
