// Every record has the same members at the same offsets in C++ and in the compiled shaders.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "licht/gpu/program.h"
#include "licht/shared/bvh_layout.h"
#include "licht/shared/counters.h"
#include "licht/shared/device_check.h"
#include "licht/shared/frame.h"
#include "licht/shared/geometry.h"
#include "licht/shared/light.h"
#include "licht/shared/material.h"
#include "licht/shared/path.h"
#include "licht/shared/ray_records.h"
#include "licht/shared/signals.h"
#include "licht/spirv/records_comp.h"

namespace licht {
namespace {

using gpu::ReflectedMember;

/// What aggregate initialisation takes for any member.
struct Anything {
    template <typename T>
    operator T() const;
};

/// How many members an aggregate has: the most initialisers that it takes.
template <typename Record, typename... Initialisers>
constexpr std::size_t memberCount() {
    if constexpr (requires { Record{Initialisers{}..., Anything{}}; })
        return memberCount<Record, Initialisers..., Anything>();
    else
        return sizeof...(Initialisers);
}

struct Record {
    std::size_t size;
    std::size_t member_count;
    std::vector<ReflectedMember> members;
};

ReflectedMember member(std::string name, std::size_t offset, std::size_t size) {
    return {std::move(name), static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(size)};
}

#define LICHT_RECORD(record, ...)                    \
    {                                                \
#record, Record {                            \
            sizeof(record), memberCount<record>(), { \
                __VA_ARGS__                          \
            }                                        \
        }                                            \
    }
#define LICHT_MEMBER(record, name) member(#name, offsetof(record, name), sizeof(record::name))

std::map<std::string, Record> hostRecords() {
    return {
        LICHT_RECORD(VertexRecord, LICHT_MEMBER(VertexRecord, position), LICHT_MEMBER(VertexRecord, u),
                     LICHT_MEMBER(VertexRecord, normal), LICHT_MEMBER(VertexRecord, v)),
        LICHT_RECORD(InstanceRecord, LICHT_MEMBER(InstanceRecord, first_triangle),
                     LICHT_MEMBER(InstanceRecord, material), LICHT_MEMBER(InstanceRecord, first_light),
                     LICHT_MEMBER(InstanceRecord, flags)),
        LICHT_RECORD(TextureSlotRecord, LICHT_MEMBER(TextureSlotRecord, u_from_uv),
                     LICHT_MEMBER(TextureSlotRecord, texture), LICHT_MEMBER(TextureSlotRecord, v_from_uv),
                     LICHT_MEMBER(TextureSlotRecord, flags)),
        LICHT_RECORD(TextureRecord, LICHT_MEMBER(TextureRecord, page),
                     LICHT_MEMBER(TextureRecord, first_word), LICHT_MEMBER(TextureRecord, width),
                     LICHT_MEMBER(TextureRecord, height), LICHT_MEMBER(TextureRecord, words_per_texel),
                     LICHT_MEMBER(TextureRecord, reserved0), LICHT_MEMBER(TextureRecord, reserved1),
                     LICHT_MEMBER(TextureRecord, reserved2)),
        LICHT_RECORD(MaterialRecord, LICHT_MEMBER(MaterialRecord, base_color),
                     LICHT_MEMBER(MaterialRecord, emission), LICHT_MEMBER(MaterialRecord, metallic),
                     LICHT_MEMBER(MaterialRecord, specular_color), LICHT_MEMBER(MaterialRecord, roughness),
                     LICHT_MEMBER(MaterialRecord, specular), LICHT_MEMBER(MaterialRecord, dielectric_f0),
                     LICHT_MEMBER(MaterialRecord, normal_scale), LICHT_MEMBER(MaterialRecord, alpha_cutoff),
                     LICHT_MEMBER(MaterialRecord, flags), LICHT_MEMBER(MaterialRecord, slots),
                     LICHT_MEMBER(MaterialRecord, blocks), LICHT_MEMBER(MaterialRecord, first_detail)),
        LICHT_RECORD(IridescenceRecord, LICHT_MEMBER(IridescenceRecord, factor),
                     LICHT_MEMBER(IridescenceRecord, ior), LICHT_MEMBER(IridescenceRecord, thickness_minimum),
                     LICHT_MEMBER(IridescenceRecord, thickness_maximum)),
        LICHT_RECORD(ClearcoatRecord, LICHT_MEMBER(ClearcoatRecord, factor),
                     LICHT_MEMBER(ClearcoatRecord, roughness), LICHT_MEMBER(ClearcoatRecord, normal_scale),
                     LICHT_MEMBER(ClearcoatRecord, reserved)),
        LICHT_RECORD(LightRecord, LICHT_MEMBER(LightRecord, a), LICHT_MEMBER(LightRecord, kind),
                     LICHT_MEMBER(LightRecord, b), LICHT_MEMBER(LightRecord, u), LICHT_MEMBER(LightRecord, c),
                     LICHT_MEMBER(LightRecord, v), LICHT_MEMBER(LightRecord, d), LICHT_MEMBER(LightRecord, w),
                     LICHT_MEMBER(LightRecord, instance), LICHT_MEMBER(LightRecord, primitive),
                     LICHT_MEMBER(LightRecord, pmf), LICHT_MEMBER(LightRecord, trail)),
        LICHT_RECORD(LightChildRecord, LICHT_MEMBER(LightChildRecord, centre),
                     LICHT_MEMBER(LightChildRecord, intensity), LICHT_MEMBER(LightChildRecord, half_size),
                     LICHT_MEMBER(LightChildRecord, mean_normal), LICHT_MEMBER(LightChildRecord, axis),
                     LICHT_MEMBER(LightChildRecord, cos_reach), LICHT_MEMBER(LightChildRecord, sin_reach),
                     LICHT_MEMBER(LightChildRecord, next), LICHT_MEMBER(LightChildRecord, radius),
                     LICHT_MEMBER(LightChildRecord, softening)),
        LICHT_RECORD(AliasRecord, LICHT_MEMBER(AliasRecord, threshold), LICHT_MEMBER(AliasRecord, alias),
                     LICHT_MEMBER(AliasRecord, pmf), LICHT_MEMBER(AliasRecord, reserved)),
        LICHT_RECORD(ViewRecord, LICHT_MEMBER(ViewRecord, eye), LICHT_MEMBER(ViewRecord, orthographic),
                     LICHT_MEMBER(ViewRecord, right), LICHT_MEMBER(ViewRecord, scale_x),
                     LICHT_MEMBER(ViewRecord, up), LICHT_MEMBER(ViewRecord, scale_y),
                     LICHT_MEMBER(ViewRecord, back), LICHT_MEMBER(ViewRecord, z_near),
                     LICHT_MEMBER(ViewRecord, size), LICHT_MEMBER(ViewRecord, z_far),
                     LICHT_MEMBER(ViewRecord, z_limit)),
        LICHT_RECORD(FrameRecord, LICHT_MEMBER(FrameRecord, view), LICHT_MEMBER(FrameRecord, previous_view),
                     LICHT_MEMBER(FrameRecord, light_slots), LICHT_MEMBER(FrameRecord, environment_light),
                     LICHT_MEMBER(FrameRecord, environment_size), LICHT_MEMBER(FrameRecord, bounces),
                     LICHT_MEMBER(FrameRecord, roulette_start), LICHT_MEMBER(FrameRecord, seed),
                     LICHT_MEMBER(FrameRecord, extra_uv_sets), LICHT_MEMBER(FrameRecord, has_sky),
                     LICHT_MEMBER(FrameRecord, clamp_limit), LICHT_MEMBER(FrameRecord, tree_lights),
                     LICHT_MEMBER(FrameRecord, environment_peak), LICHT_MEMBER(FrameRecord, first_sun),
                     LICHT_MEMBER(FrameRecord, suns), LICHT_MEMBER(FrameRecord, environment_turn),
                     LICHT_MEMBER(FrameRecord, reserved0)),
        LICHT_RECORD(FilterPush, LICHT_MEMBER(FilterPush, size), LICHT_MEMBER(FilterPush, orthographic),
                     LICHT_MEMBER(FilterPush, stride), LICHT_MEMBER(FilterPush, count_a),
                     LICHT_MEMBER(FilterPush, count_b)),
        LICHT_RECORD(ReprojectPush, LICHT_MEMBER(ReprojectPush, sample_index),
                     LICHT_MEMBER(ReprojectPush, fresh), LICHT_MEMBER(ReprojectPush, changed)),
        LICHT_RECORD(GradientPush, LICHT_MEMBER(GradientPush, sample_index),
                     LICHT_MEMBER(GradientPush, stride)),
        LICHT_RECORD(SamplePush, LICHT_MEMBER(SamplePush, sample_index),
                     LICHT_MEMBER(SamplePush, count_before), LICHT_MEMBER(SamplePush, first_row),
                     LICHT_MEMBER(SamplePush, row_count)),
        LICHT_RECORD(
            CounterRecord, LICHT_MEMBER(CounterRecord, bounce_rays), LICHT_MEMBER(CounterRecord, shadow_rays),
            LICHT_MEMBER(CounterRecord, nonfinite_samples), LICHT_MEMBER(CounterRecord, truncated_traversals),
            LICHT_MEMBER(CounterRecord, environment_samples), LICHT_MEMBER(CounterRecord, environment_tries),
            LICHT_MEMBER(CounterRecord, queue_balance)),
        LICHT_RECORD(CheckQuestion, LICHT_MEMBER(CheckQuestion, near_one),
                     LICHT_MEMBER(CheckQuestion, factor), LICHT_MEMBER(CheckQuestion, tiny),
                     LICHT_MEMBER(CheckQuestion, beyond)),
        LICHT_RECORD(CheckAnswer, LICHT_MEMBER(CheckAnswer, stored), LICHT_MEMBER(CheckAnswer, word_texel),
                     LICHT_MEMBER(CheckAnswer, float_texel), LICHT_MEMBER(CheckAnswer, sum),
                     LICHT_MEMBER(CheckAnswer, product), LICHT_MEMBER(CheckAnswer, product_less),
                     LICHT_MEMBER(CheckAnswer, lost), LICHT_MEMBER(CheckAnswer, finite),
                     LICHT_MEMBER(CheckAnswer, converted), LICHT_MEMBER(CheckAnswer, halves),
                     LICHT_MEMBER(CheckAnswer, bits), LICHT_MEMBER(CheckAnswer, wrapped),
                     LICHT_MEMBER(CheckAnswer, group_sum), LICHT_MEMBER(CheckAnswer, place),
                     LICHT_MEMBER(CheckAnswer, distance)),
        LICHT_RECORD(BallotAnswer, LICHT_MEMBER(BallotAnswer, ballot), LICHT_MEMBER(BallotAnswer, subgroup),
                     LICHT_MEMBER(BallotAnswer, lane), LICHT_MEMBER(BallotAnswer, lanes),
                     LICHT_MEMBER(BallotAnswer, bits), LICHT_MEMBER(BallotAnswer, bits_below),
                     LICHT_MEMBER(BallotAnswer, elected), LICHT_MEMBER(BallotAnswer, first),
                     LICHT_MEMBER(BallotAnswer, place), LICHT_MEMBER(BallotAnswer, rounds),
                     LICHT_MEMBER(BallotAnswer, reserved0), LICHT_MEMBER(BallotAnswer, reserved1),
                     LICHT_MEMBER(BallotAnswer, reserved2)),
        LICHT_RECORD(AdaptiveTileRecord, LICHT_MEMBER(AdaptiveTileRecord, end),
                     LICHT_MEMBER(AdaptiveTileRecord, behind)),
        LICHT_RECORD(TonemapPush, LICHT_MEMBER(TonemapPush, exposure), LICHT_MEMBER(TonemapPush, curve)),
        LICHT_RECORD(WavefrontPush, LICHT_MEMBER(WavefrontPush, sample_index),
                     LICHT_MEMBER(WavefrontPush, first_row), LICHT_MEMBER(WavefrontPush, row_count),
                     LICHT_MEMBER(WavefrontPush, bounce)),
        LICHT_RECORD(RayRecord, LICHT_MEMBER(RayRecord, origin), LICHT_MEMBER(RayRecord, t_min),
                     LICHT_MEMBER(RayRecord, direction), LICHT_MEMBER(RayRecord, t_max)),
        LICHT_RECORD(RayHitRecord, LICHT_MEMBER(RayHitRecord, triangle), LICHT_MEMBER(RayHitRecord, t),
                     LICHT_MEMBER(RayHitRecord, b1), LICHT_MEMBER(RayHitRecord, b2)),
        LICHT_RECORD(RayRange, LICHT_MEMBER(RayRange, first), LICHT_MEMBER(RayRange, count)),
        LICHT_RECORD(BvhNode, LICHT_MEMBER(BvhNode, origin), LICHT_MEMBER(BvhNode, head),
                     LICHT_MEMBER(BvhNode, planes_x), LICHT_MEMBER(BvhNode, planes_y),
                     LICHT_MEMBER(BvhNode, planes_z)),
        LICHT_RECORD(
            InstanceTransformRecord, LICHT_MEMBER(InstanceTransformRecord, world_x),
            LICHT_MEMBER(InstanceTransformRecord, pivot_x), LICHT_MEMBER(InstanceTransformRecord, world_y),
            LICHT_MEMBER(InstanceTransformRecord, pivot_y), LICHT_MEMBER(InstanceTransformRecord, world_z),
            LICHT_MEMBER(InstanceTransformRecord, pivot_z), LICHT_MEMBER(InstanceTransformRecord, condition),
            LICHT_MEMBER(InstanceTransformRecord, mirrored), LICHT_MEMBER(InstanceTransformRecord, reserved0),
            LICHT_MEMBER(InstanceTransformRecord, reserved1)),
    };
}

#undef LICHT_MEMBER
#undef LICHT_RECORD

/// Records that are members of others, by the members' names: reflection lists what is in them.
std::string nestedRecord(const std::string& member) {
    return member.ends_with("view") ? "ViewRecord" : "";
}

std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> flatten(
    const Record& record, const std::map<std::string, Record>& records) {
    std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> flat;
    for (const ReflectedMember& m : record.members) {
        const std::string nested = nestedRecord(m.name);
        if (nested.empty()) {
            flat[m.name] = {m.offset, m.size};
            continue;
        }
        for (const auto& [name, place] : flatten(records.at(nested), records))
            flat[m.name + "." + name] = {m.offset + place.first, place.second};
    }
    return flat;
}

TEST(Records, deviceAndHostAgreeOnEveryMember) {
    const std::map<std::string, Record> records = hostRecords();
    for (const auto& [name, record] : records) {
        EXPECT_EQ(record.members.size(), record.member_count) << name << ": not every member is listed here";
        std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> device;
        for (const ReflectedMember& m : gpu::reflectStruct(records_comp, name))
            device[m.name] = {m.offset, m.size};
        ASSERT_EQ(device.count(""), 1U) << name << " is not in records.comp";
        EXPECT_EQ(device[""].second, record.size) << name;
        device.erase("");
        EXPECT_EQ(device, flatten(record, records)) << name;
    }
}

TEST(Records, noneIsForgotten) {
    std::set<std::string> declared;
    const auto folder = std::filesystem::path(LICHT_SOURCE) / "shaders" / "shared";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().filename() == "light_views.h") continue;  // they stand in no buffer
        std::ifstream stream(entry.path());
        ASSERT_TRUE(stream) << entry.path();
        std::stringstream text;
        text << stream.rdbuf();
        const std::string source = text.str();
        const std::regex declaration(R"((?:^|\n)struct (\w+))");
        for (std::sregex_iterator it(source.begin(), source.end(), declaration), end; it != end; ++it)
            declared.insert((*it)[1]);
    }
    std::set<std::string> tested;
    for (const auto& [name, record] : hostRecords()) tested.insert(name);
    EXPECT_EQ(declared, tested);
}

}  // namespace
}  // namespace licht
