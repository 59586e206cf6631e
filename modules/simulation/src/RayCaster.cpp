#include "lamp/simulation/RayCaster.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <stdexcept>

namespace lamp::simulation {

struct RayCaster::Scene {
  // Not "threads=1": Embree would set that limit for all of TBB.
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = nullptr;

  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

RTCRay makeRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near,
               float far) {
  RTCRay ray{};
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = ~0u;
  return ray;
}

}  // namespace

RayCaster::RayCaster(const Mesh& mesh) : mesh_(mesh), scene_(std::make_unique<Scene>()) {
  if (!scene_->device) throw std::runtime_error("Embree cannot start");
  scene_->scene = rtcNewScene(scene_->device);
  // Robust: no ray slips through between two triangles.
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
  auto* triangles = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), mesh.triangles.size()));
  if (!vertices || !triangles) throw std::runtime_error("Embree has no memory for the world");
  for (const Eigen::Vector3f& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) *vertices++ = v[axis];
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t index : triangle) *triangles++ = index;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_->scene);
}

RayCaster::~RayCaster() = default;

std::optional<RayHit> RayCaster::cast(const Eigen::Vector3f& origin,
                                      const Eigen::Vector3f& direction, float max_range_m) const {
  RTCRayHit ray{};
  ray.ray = makeRay(origin, direction, 0.0f, max_range_m);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{ray.ray.tfar, ray.hit.primID};
}

bool RayCaster::visible(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
  constexpr float kMargin = 0.05f;
  const float length = (to - from).norm();
  if (length <= 2 * kMargin) return true;
  RTCRay ray = makeRay(from, (to - from) / length, kMargin, length - kMargin);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->scene, &context, &ray);
  return ray.tfar >= 0;  // Embree marks an occluded ray with minus infinity
}

}  // namespace lamp::simulation
