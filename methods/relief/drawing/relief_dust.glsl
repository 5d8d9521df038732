// The shadow of the dust (kit/draw/opaque_dust.glsl) in the panel's frame.
#ifdef DUST
uniform mat4 eyeToDust;  // from the panel's frame to the map of the dust's columns
#endif
