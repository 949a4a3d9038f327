#version 450

// Particles that are shown as mass are projected.

#define KIND_OF_LIGHT 1
#include "wheatstone/multiview/project_splats.glsl"
