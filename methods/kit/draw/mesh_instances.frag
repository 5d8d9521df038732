// A matt surface lit by sun and sky, premultiplied; discarded behind the opaque scene.
in vec3 outwards;
in vec3 fromEye;
in vec3 diffuse;
flat in float opacity;

uniform vec3 toSun;
uniform vec3 sun;
uniform vec3 ambient;
layout(binding = 1) uniform sampler2D sceneDepth;

layout(location = 0) out vec4 colour;

void main() {
    if (gl_FragCoord.z < texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r) discard;
    vec3 normal = normalize(outwards);
    if (dot(normal, fromEye) > 0.0) normal = -normal;  // meshes may have either winding
    vec3 lit = diffuse * (sun * max(dot(normal, toSun), 0.0) + ambient * (0.75 + 0.25 * normal.y));
    colour = vec4(lit * opacity, opacity);
}
