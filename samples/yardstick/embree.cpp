#include <algorithm>
#include <atomic>
#include <cstring>
#include <thread>

#if LICHT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <fmt/format.h>

#include "licht/core/clock.h"
#include "licht/core/error.h"
#include "licht/shared/index.h"
#include "samples/yardstick/yardstick.h"

namespace licht {
namespace {

// The two versions differ in where the options of a call stand.
#if LICHT_EMBREE_MAJOR >= 4
template <auto intersect8, typename Rays>
void callPacket(const int* valid, RTCScene scene, Rays& rays, bool coherent) {
    RTCRayQueryContext context;
    rtcInitRayQueryContext(&context);
    if constexpr (requires(RTCIntersectArguments a) { intersect8(valid, scene, &rays, &a); }) {
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.context = &context;
        if (coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
        intersect8(valid, scene, &rays, &arguments);
    } else {
        RTCOccludedArguments arguments;
        rtcInitOccludedArguments(&arguments);
        arguments.context = &context;
        if (coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
        intersect8(valid, scene, &rays, &arguments);
    }
}

void intersectOne(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray);
}

void occludedOne(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray);
}
#else
RTCIntersectContext contextOf(bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

template <auto call, typename Rays>
void callPacket(const int* valid, RTCScene scene, Rays& rays, bool coherent) {
    RTCIntersectContext context = contextOf(coherent);
    call(valid, scene, &context, &rays);
}

void intersectOne(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context = contextOf(false);
    rtcIntersect1(scene, &context, &ray);
}

void occludedOne(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context = contextOf(false);
    rtcOccluded1(scene, &context, &ray);
}
#endif

RTCRay rayOf(const RayRecord& r) {
    RTCRay ray{};
    ray.org_x = r.origin.x;
    ray.org_y = r.origin.y;
    ray.org_z = r.origin.z;
    ray.tnear = r.t_min;
    ray.dir_x = r.direction.x;
    ray.dir_y = r.direction.y;
    ray.dir_z = r.direction.z;
    ray.tfar = r.t_max;
    ray.mask = 0xffffffffU;
    return ray;
}

// Occlusion is answered by a tfar of minus infinity.
bool isOccluded(float tfar) {
    return tfar < 0.0F;
}

void traceOneByOne(RTCScene scene, std::span<const RayRecord> rays, bool any_hit,
                   std::span<RayHitRecord> hits) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        RTCRayHit query{};
        query.ray = rayOf(rays[i]);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        if (any_hit) {
            occludedOne(scene, query.ray);
            hits[i].triangle = isOccluded(query.ray.tfar) ? 0U : kNoIndex;
        } else {
            intersectOne(scene, query);
            const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
            hits[i] = {hit ? query.hit.primID : kNoIndex, query.ray.tfar, query.hit.u, query.hit.v};
        }
    }
}

template <typename Ray>
void setLane(Ray& to, unsigned lane, const RayRecord& r) {
    to.org_x[lane] = r.origin.x;
    to.org_y[lane] = r.origin.y;
    to.org_z[lane] = r.origin.z;
    to.tnear[lane] = r.t_min;
    to.dir_x[lane] = r.direction.x;
    to.dir_y[lane] = r.direction.y;
    to.dir_z[lane] = r.direction.z;
    to.tfar[lane] = r.t_max;
    to.time[lane] = 0.0F;
    to.mask[lane] = 0xffffffffU;
    to.id[lane] = lane;
    to.flags[lane] = 0;
}

template <unsigned width, typename RayHit, auto intersect, auto occluded>
void tracePackets(RTCScene scene, std::span<const RayRecord> rays, bool any_hit, bool coherent,
                  std::span<RayHitRecord> hits) {
    alignas(64) int valid[width];
    alignas(64) RayHit packet;
    for (std::size_t first = 0; first < rays.size(); first += width) {
        const auto lanes = static_cast<unsigned>(std::min<std::size_t>(width, rays.size() - first));
        for (unsigned lane = 0; lane < width; ++lane) {
            valid[lane] = lane < lanes ? -1 : 0;
            setLane(packet.ray, lane, rays[first + std::min(lane, lanes - 1)]);
            packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        if (any_hit) {
            callPacket<occluded>(valid, scene, packet.ray, coherent);
            for (unsigned lane = 0; lane < lanes; ++lane)
                hits[first + lane].triangle = isOccluded(packet.ray.tfar[lane]) ? 0U : kNoIndex;
        } else {
            callPacket<intersect>(valid, scene, packet, coherent);
            for (unsigned lane = 0; lane < lanes; ++lane) {
                const bool hit = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
                hits[first + lane] = {hit ? packet.hit.primID[lane] : kNoIndex, packet.ray.tfar[lane],
                                      packet.hit.u[lane], packet.hit.v[lane]};
            }
        }
    }
}

class Embree final : public Yardstick {
public:
    Embree(std::span<const BvhTriangle> triangles, bool robust)
        : device_(rtcNewDevice(nullptr)), threads_(std::max(1U, std::thread::hardware_concurrency())) {
        if (device_ == nullptr) throw DeviceError("Embree does not start on this machine");
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        static_assert(sizeof(BvhTriangle) == 9 * sizeof(float));
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                                    3 * std::max<std::size_t>(1, triangles.size()));
        if (!triangles.empty()) std::memcpy(vertices, triangles.data(), triangles.size_bytes());
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), triangles.size()));
        for (std::size_t i = 0; i < 3 * triangles.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
        scene_ = rtcNewScene(device_);
        if (robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        const Clock::time_point start = Clock::now();
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
        build_seconds_ = secondsSince(start);
        if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE)
            throw DeviceError(fmt::format("Embree reports error {}", static_cast<int>(error)));
    }
    ~Embree() override {
        if (scene_ != nullptr) rtcReleaseScene(scene_);
        if (device_ != nullptr) rtcReleaseDevice(device_);
    }

    [[nodiscard]] std::string version() const override { return RTC_VERSION_STRING; }
    [[nodiscard]] double buildSeconds() const override { return build_seconds_; }
    [[nodiscard]] std::uint32_t threads() const override { return threads_; }

    [[nodiscard]] std::vector<YardstickCall> packetCalls() const override {
        std::vector<YardstickCall> calls;
        const auto add = [&](RTCDeviceProperty property, std::uint32_t width) {
            if (rtcGetDeviceProperty(device_, property) == 0) return;
            calls.push_back({width, false});
            calls.push_back({width, true});
        };
        add(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED, 8);
        add(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED, 16);
        return calls;
    }

    double trace(std::span<const RayRecord> rays, bool any_hit, const YardstickCall& call,
                 std::span<RayHitRecord> hits) override {
        constexpr std::size_t kChunk = 1024;  // 16 tiles of the picture
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
            for (std::size_t first = next.fetch_add(kChunk); first < rays.size();
                 first = next.fetch_add(kChunk)) {
                const std::size_t count = std::min(kChunk, rays.size() - first);
                const auto some = rays.subspan(first, count);
                const auto theirs = hits.subspan(first, count);
                if (call.width == 16)
                    tracePackets<16, RTCRayHit16, rtcIntersect16, rtcOccluded16>(scene_, some, any_hit,
                                                                                 call.coherent, theirs);
                else if (call.width == 8)
                    tracePackets<8, RTCRayHit8, rtcIntersect8, rtcOccluded8>(scene_, some, any_hit,
                                                                             call.coherent, theirs);
                else
                    traceOneByOne(scene_, some, any_hit, theirs);
            }
        };
        const Clock::time_point start = Clock::now();
        std::vector<std::jthread> helpers;
        for (std::uint32_t i = 1; i < threads_; ++i) helpers.emplace_back(work);
        work();
        helpers.clear();
        return secondsSince(start);
    }

private:
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::uint32_t threads_;
    double build_seconds_ = 0.0;
};

}  // namespace

std::unique_ptr<Yardstick> makeYardstick(std::span<const BvhTriangle> triangles, bool robust) {
    return std::make_unique<Embree>(triangles, robust);
}

}  // namespace licht
