// Drawn three times a frame (eddy.toml): a chain of three buffers in one. Channel 0 is this buffer.
#include "step.glsl"
