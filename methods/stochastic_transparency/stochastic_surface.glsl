/// A puff's surface at a pixel. `nearness` is n/z of its place, as reversed depth: 1 at the near plane, 0 at infinity.
struct Surface {
    float depth;  // optical depth; 0: not drawn
    float nearness;
};

/// The sight: `ray` has length 1 along the camera's axis. `scene`: the scene's reversed depth.
Surface surfaceOf(vec4 centre, float logDepth, vec3 ray, float scene, float nearMetres) {
    float stretch = length(ray);
    float sceneMetres = sceneMetresOf(scene, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, sceneMetres);
#if VOLUME == 1
    float metres = clamp(puff.foot, nearMetres, max(sceneMetres, nearMetres)) / stretch;
    return Surface(puff.whole * shareOnRay(puff), nearMetres / metres);
#else
    float nearness = nearMetres / max(-centre.z, nearMetres);
    bool visible = -centre.z > nearMetres && nearness >= scene;
    return Surface(visible ? puff.whole : 0.0, nearness);
#endif
}
