layout(location = 0) in vec3 position;  // relative to the anchor
layout(location = 1) in vec3 normal;

uniform vec3 anchorFromEye;
uniform vec2 anchorPhase;  // the anchor's position in the patch tile, in tiles
#ifdef TRACK
uniform float anchorAcross;  // the anchor's world z
layout(location = 3) out float acrossTrack;
#endif

layout(location = 0) out vec3 fromEye;
layout(location = 1) out vec2 place;
#ifdef RELIEF
layout(location = 2) out vec3 groundNormal;
#endif

invariant gl_Position;

void main() {
    fromEye = position + anchorFromEye;
    place = position.xz * TILES_PER_METRE + anchorPhase;
#ifdef RELIEF
    groundNormal = normal;
#endif
#ifdef TRACK
    acrossTrack = position.z + anchorAcross;
#endif
    gl_Position = eyeToClip * vec4(fromEye, 1.0);
}
