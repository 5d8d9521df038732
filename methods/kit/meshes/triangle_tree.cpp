#include "methods/kit/meshes/triangle_tree.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "methods/contract/errors.h"

namespace dustbench::meshes {

namespace {

/// The nearest triangle on a ray. Embree 3 requires a context.
void intersect(RTCScene scene, RTCRayHit& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
}

}  // namespace

struct TriangleTree::Embree {
    Embree() {
        // Not `threads=1`, because Embree would then limit oneTBB in the whole program.
        device = rtcNewDevice("set_affinity=0");
        if (!device) throw InputError("collision: Embree does not start on this machine");
        rtcSetDeviceMemoryMonitorFunction(
            device,
            [](void* sum, ssize_t change, bool) {
                *static_cast<std::atomic<std::ptrdiff_t>*>(sum) += change;
                return true;
            },
            &bytes);
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    }
    ~Embree() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::atomic<std::ptrdiff_t> bytes{0};
};

TriangleTree::TriangleTree() : embree_(std::make_unique<Embree>()) {}
TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

void TriangleTree::add(const scene::Mesh& mesh, const glm::mat4& toWorld) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::vec3, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k)
            triangle[k] = glm::vec3(toWorld * glm::vec4(mesh.positions[mesh.indices[i + k]], 1));
        corners_.push_back(triangle);
    }
}

void TriangleTree::build() {
    if (corners_.empty()) return;
    const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    sizeof(glm::vec3), corners_.size() * 3);
    auto* const indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), corners_.size()));
    if (!positions || !indices) throw InputError("collision: not enough memory for the triangles of the solids");
    std::memcpy(positions, corners_.data(), corners_.size() * sizeof corners_.front());
    for (std::uint32_t i = 0; i < corners_.size() * 3; ++i) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_->scene, geometry);
    rtcReleaseGeometry(geometry);
    // Built with one thread, so that the tree is always the same.
    tbb::task_arena(1).execute([&] { rtcCommitScene(embree_->scene); });
    if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE)
        throw InputError("collision: Embree cannot build a tree of " + std::to_string(corners_.size()) + " triangles");
}

std::optional<TriangleTree::Hit> TriangleTree::firstHit(const glm::vec3& from, const glm::vec3& to) const {
    if (corners_.empty()) return std::nullopt;
    const glm::vec3 way = to - from;
    RTCRayHit query{};
    query.ray.org_x = from.x;
    query.ray.org_y = from.y;
    query.ray.org_z = from.z;
    query.ray.dir_x = way.x;
    query.ray.dir_y = way.y;
    query.ray.dir_z = way.z;
    query.ray.tfar = 1;
    query.ray.mask = 0xffffffffu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(embree_->scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

    // n·(from + s·way − v0) = 0
    const auto& corners = corners_[query.hit.primID];
    const glm::dvec3 v0(corners[0]);
    glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - v0, glm::dvec3(corners[2]) - v0);
    const double length = glm::length(normal);
    if (!(length > 0)) return std::nullopt;
    normal /= length;
    const double towards = glm::dot(normal, glm::dvec3(way)), height = glm::dot(normal, glm::dvec3(from) - v0);
    if (height < 0) normal = -normal;
    const double share = towards != 0 ? std::clamp(-height / towards, 0.0, 1.0) : 0.0;
    return Hit{static_cast<float>(share), glm::vec3(normal)};
}

namespace {

/// Weights of the point of a triangle nearest to p: its projection on the plane if inside, otherwise on an edge.
glm::dvec3 nearestOn(const std::array<glm::vec3, 3>& corners, const glm::dvec3& p) {
    const std::array<glm::dvec3, 3> v{glm::dvec3(corners[0]), glm::dvec3(corners[1]), glm::dvec3(corners[2])};
    const glm::dvec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
    const double area = glm::dot(n, n);
    if (area > 0) {
        const auto share = [&](int a, int b) {
            const auto from = v[static_cast<std::size_t>(a)], to = v[static_cast<std::size_t>(b)];
            return glm::dot(glm::cross(to - from, p - from), n) / area;
        };
        const glm::dvec3 weights(share(1, 2), share(2, 0), share(0, 1));
        if (glm::all(glm::greaterThanEqual(weights, glm::dvec3(0)))) return weights;
    }
    glm::dvec3 best(1, 0, 0);
    double nearest = INFINITY;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const auto from = v[static_cast<std::size_t>(a)], way = v[static_cast<std::size_t>(b)] - from;
        const double square = glm::dot(way, way);
        const double along = square > 0 ? std::clamp(glm::dot(p - from, way) / square, 0.0, 1.0) : 0.0;
        const double distance = glm::distance(p, from + along * way);
        if (distance >= nearest) continue;
        nearest = distance;
        best = glm::dvec3(0);
        best[a] = 1 - along;
        best[b] = along;
    }
    return best;
}

struct NearestQuery {
    const std::vector<std::array<glm::vec3, 3>>& corners;
    glm::dvec3 point;
    std::optional<TriangleTree::Nearest> found{};
};

bool takeNearer(RTCPointQueryFunctionArguments* arguments) {
    auto& query = *static_cast<NearestQuery*>(arguments->userPtr);
    const auto& corners = query.corners[arguments->primID];
    const glm::dvec3 weights = nearestOn(corners, query.point);
    const glm::dvec3 place =
        weights.x * glm::dvec3(corners[0]) + weights.y * glm::dvec3(corners[1]) + weights.z * glm::dvec3(corners[2]);
    const double distance = glm::distance(place, query.point);
    const std::size_t triangle = arguments->primID;
    if (query.found && (distance > query.found->distanceMetres ||
                        (distance == query.found->distanceMetres && triangle > query.found->triangle)))
        return false;
    query.found = {triangle, weights, distance};
    // Slightly larger, so that rounding to floats does not exclude a triangle at the same distance.
    const auto radius = static_cast<float>(1.0001 * distance) + 1e-6f;
    if (radius >= arguments->query->radius) return false;
    arguments->query->radius = radius;
    return true;
}

}  // namespace

std::optional<TriangleTree::Nearest> TriangleTree::nearest(const glm::vec3& point, float radiusMetres) const {
    if (corners_.empty()) return std::nullopt;
    RTCPointQuery query{};
    query.x = point.x;
    query.y = point.y;
    query.z = point.z;
    query.radius = 1.0001f * radiusMetres + 1e-6f;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    NearestQuery own{corners_, glm::dvec3(point)};
    rtcPointQuery(embree_->scene, &query, &context, takeNearer, &own);
    if (own.found && own.found->distanceMetres > static_cast<double>(radiusMetres)) return std::nullopt;
    return own.found;
}

std::size_t TriangleTree::bytes() const {
    return corners_.capacity() * sizeof corners_.front() +
           static_cast<std::size_t>(std::max<std::ptrdiff_t>(embree_->bytes.load(), 0));
}

}  // namespace dustbench::meshes
