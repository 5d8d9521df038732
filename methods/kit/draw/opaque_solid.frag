// A matt body under a clear coat that reflects sky, ground and sun by Fresnel's law.
layout(location = 0) in vec3 fromEye;
layout(location = 1) in vec3 outwards;
layout(location = 2) in vec3 diffuse;

uniform float gloss;
#ifdef PANEL
layout(binding = 4) uniform sampler2D picture;  // `diffuse` is the place in it
#endif

layout(location = 0) out vec4 colour;

void main() {
    vec3 towardsEye = -normalize(fromEye);
    vec3 normal = normalize(outwards);
    if (dot(normal, towardsEye) < 0.0) normal = -normal;  // external meshes may have either winding

    // The sky lights the upper hemisphere of a surface, the ground the lower.
    float facing = max(dot(normal, toSun.xyz), 0.0);
    float lit = facing > 0.0 ? sunShare(fromEye, normal, 2.5) : 0.0;
#ifdef DUST
    lit *= dustShare(fromEye);
#endif
    vec3 around = mix(groundLight.rgb, ambient.rgb, 0.5 + 0.5 * normal.y);
#ifdef LAMPS
    around += lampLight(fromEye, normal);
#endif
#ifdef PANEL
    vec3 albedo = texture(picture, diffuse.xy).rgb;
#else
    vec3 albedo = diffuse;
#endif
    vec3 body = albedo * (sun.rgb * (facing * lit) + around);

    // Schlick: F = F0 + (1 − F0)(1 − cos θ)⁵, with F0 = 0.04 for lacquer and glass.
    float grazing = 1.0 - dot(normal, towardsEye);
    float grazing2 = grazing * grazing;
    float mirrored = gloss * (0.04 + 0.96 * grazing2 * grazing2 * grazing);
    vec3 reflection = reflect(-towardsEye, normal);
    vec3 environment = mix(groundLight.rgb, skyColour(reflection), smoothstep(-0.08, 0.08, reflection.y));
    float glint = pow(max(dot(reflection, toSun.xyz), 0.0), 180.0);
    vec3 coat = mirrored * (environment + sun.rgb * (20.0 * lit * glint));

    colour = vec4(throughAir(body * (1.0 - mirrored) + coat, fromEye), 1.0);
}
