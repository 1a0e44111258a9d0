#include "licht/render/images.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <set>

#include "licht/gpu/commands.h"
#include "licht/spirv/images_pair_comp.h"
#include "support/gpu_test.h"

namespace licht {
namespace {

const gpu::Image* imageIn(const std::vector<gpu::BoundResource>& resources, const std::string& name) {
    for (const gpu::BoundResource& bound : resources)
        if (bound.name == name) return std::get<const gpu::Image*>(bound.resource);
    return nullptr;
}

TEST(Images, EveryNameStandsOnce) {
    std::set<std::string_view> names;
    for (const ImageRow& row : imageTable()) EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

TEST(Images, WhatIsNotCalledForIsOneTexel) {
    RenderSettings settings;
    const Images without(gpu::testDevice(), uvec2(5, 3), settings);
    EXPECT_EQ(without["mean_high"].extent().width, 5U);
    EXPECT_EQ(without["aov_normal"].extent().width, 1U);
    settings.layers.add(LayerId::depth);
    EXPECT_EQ(Images(gpu::testDevice(), uvec2(5, 3), settings)["aov_normal"].extent().width, 5U);
}

TEST(Images, WhatIsLentIsBound) {
    Images images(gpu::testDevice(), uvec2(5, 3), {});
    const gpu::Image* nothing = imageIn(images.resources(0), "order_sums");
    ASSERT_NE(nothing, nullptr);
    EXPECT_EQ(nothing->extent().width, 1U);
    const gpu::Image sums(gpu::testDevice(), "sums", {10, 3}, VK_FORMAT_R32G32B32A32_SFLOAT,
                          VK_IMAGE_USAGE_STORAGE_BIT);
    images.lend("order_sums", sums);
    EXPECT_EQ(imageIn(images.resources(0), "order_sums"), &sums);
}

constexpr auto kPairTable = std::to_array<ImageRow>({
    {"sum", VK_FORMAT_R32G32B32A32_SFLOAT, Target::none, Lifetime::ping_pong, nullptr},
    {"single", VK_FORMAT_R32G32B32A32_SFLOAT, Target::none, Lifetime::history, nullptr},
});

TEST(Images, PairsSwapWithEveryFrame) {
    Images images(gpu::testDevice(), uvec2(4, 4), {}, kPairTable);
    EXPECT_EQ(images.parities(), 2U);
    EXPECT_FALSE(images.hasPrevious());
    const gpu::Image* first = &images["sum"];
    const gpu::Image* single = &images["single"];
    EXPECT_EQ(imageIn(images.resources(0), "sum"), first);
    images.next();
    EXPECT_TRUE(images.hasPrevious());
    EXPECT_EQ(images.parity(), 1U);
    EXPECT_NE(&images["sum"], first);
    EXPECT_EQ(&images["single"], single);
    EXPECT_EQ(imageIn(images.resources(1), "sum"), &images["sum"]);
    EXPECT_EQ(imageIn(images.resources(1), "previous_sum"), first);
    images.next();
    EXPECT_EQ(&images["sum"], first);
    EXPECT_EQ(Images(gpu::testDevice(), uvec2(4, 4), {}).parities(), 1U) << "nothing to swap";
}

TEST(Images, AFilterReadsWhatTheLastFrameWrote) {
    gpu::Device& device = gpu::testDevice();
    const uvec2 size(13, 5);
    Images images(device, size, {}, kPairTable);
    const gpu::Program program = gpu::Program::compute(device, "pair", images_pair_comp, {});
    std::vector<gpu::Bindings> bindings;
    for (std::size_t parity = 0; parity < images.parities(); ++parity)
        bindings.emplace_back(device, program, images.resources(parity));
    gpu::Commands commands(device);
    commands.begin();
    constexpr int kFrames = 5;
    for (int frame = 0; frame < kFrames; ++frame) {
        if (frame > 0) images.next();
        const std::uint32_t has_previous = images.hasPrevious() ? 1U : 0U;
        commands.dispatch("pair", {program, bindings[images.parity()]}, has_previous, {size.x, size.y});
    }
    commands.submit();
    commands.wait();
    const std::vector<std::byte> bytes = gpu::readImage(device, images["sum"]);
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(float)) {
        float value = 0.0F;
        std::memcpy(&value, &bytes[at], sizeof(value));
        ASSERT_EQ(value, static_cast<float>(kFrames));
    }
}

}  // namespace
}  // namespace licht
