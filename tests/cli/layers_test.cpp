#include "licht/settings/layers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "licht/film/develop.h"
#include "samples/licht/command_line.h"
#include "samples/licht/exr_layers.h"
#include "samples/licht/options.h"

namespace licht {
namespace {

TEST(Layers, EveryRowIsAskedForByItsNameAndSaidByTheHelp) {
    const std::array arguments{"licht", "render", "--help"};
    const Command command = parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
    const std::string& help = std::get<PrintedText>(command).text;
    LayerSet all;
    std::set<std::string_view> names;
    for (const LayerInfo& layer : layerTable()) {
        EXPECT_TRUE(names.insert(layer.name).second) << layer.name;
        EXPECT_FALSE(layer.meaning.empty());
        EXPECT_EQ(parseLayers("--aov", layer.name), LayerSet{layer.id});
        all.add(layer.id);
    }
    EXPECT_EQ(all, allLayers());
    EXPECT_NE(help.find(layerNames()), std::string::npos) << help;
}

vec4 texelOf(const std::string_view image) {
    return image == kHitsImage ? vec4(2.0F, 4.0F, 6.0F, 2.0F) : vec4(3.0F, 0.0F, 4.0F, 10.0F);
}

/// A film of one pixel with everything in it, developed from what passes leave of four samples.
Film everything(const vec4& hits) {
    Film film;
    film.size = uvec2(1);
    film.samples = 4;
    film.mean = Image(1, 1, 4);
    film.variance = Image(1, 1, 3);
    film.orders.assign(2, Image(1, 1, 3));
    LayerTexels images;
    for (const std::string_view name : layerImages()) {
        const vec4 texel = name == kHitsImage ? hits : texelOf(name);
        images[name].resize(sizeof(texel));
        std::memcpy(images[name].data(), &texel, sizeof(texel));
    }
    developLayers(film, allLayers(), film.samples, images);
    return film;
}

TEST(Layers, EveryRowHasItsChannels) {
    const Film film = everything(texelOf(kHitsImage));
    std::set<std::string> names;
    for (const LayerInfo& layer : layerTable()) {
        const ExrPicture picture = exrPicture(film, {layer.id}, {});
        const std::size_t pictures = layer.id == LayerId::bounces ? film.orders.size() : 1;
        ASSERT_EQ(picture.channels.size(), 4 + pictures * layer.channelCount()) << layer.name;
        for (std::size_t i = 4; i < picture.channels.size(); ++i) {
            EXPECT_TRUE(names.insert(picture.channels[i].name).second) << picture.channels[i].name;
            EXPECT_EQ(picture.channels[i].values.size(), 1U);
        }
    }
    for (const char* name : {"albedo.G", "N.X", "Z", "motion.Y", "variance.B", "sampleCount", "bounces.1.R"})
        EXPECT_EQ(names.count(name), 1U) << name;
}

TEST(Layers, AreFinishedByTheirRules) {
    const Film film = everything(texelOf(kHitsImage));
    EXPECT_EQ(film.layer(LayerId::albedo).texels, (std::vector<float>{0.5F, 1.0F, 1.5F}));
    EXPECT_EQ(film.layer(LayerId::normal).texels, (std::vector<float>{0.6F, 0.0F, 0.8F}));
    EXPECT_EQ(film.layer(LayerId::depth).texels, (std::vector<float>{5.0F}));
    EXPECT_EQ(film.layer(LayerId::motion).texels, (std::vector<float>{3.0F, 0.0F}));
    EXPECT_TRUE(film.layer(LayerId::variance).texels.empty()) << "drawn by no pass";
    const Film missed = everything(vec4(0.0F));
    EXPECT_EQ(missed.layer(LayerId::depth).texels,
              (std::vector<float>{std::numeric_limits<float>::infinity()}));
    EXPECT_EQ(missed.layer(LayerId::albedo).texels, std::vector<float>(3, 0.0F));
}

TEST(Layers, OnlyPassesDrawnAreCalledFor) {
    EXPECT_FALSE((LayerSet{LayerId::variance, LayerId::sample_count, LayerId::bounces}.anyDrawn()));
    EXPECT_TRUE(LayerSet{LayerId::motion}.anyDrawn());
    EXPECT_FALSE(LayerSet{}.anyDrawn());
}

}  // namespace
}  // namespace licht
