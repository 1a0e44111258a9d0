#pragma once
// What can be chosen by name: the values, and beside them their names and a word on each, as the command
// line, its help, reports and files say them.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "licht/bvh/bvh.h"
#include "licht/shared/choices.h"

namespace licht {

template <typename Choice>
struct NamedChoice {
    std::string_view name;
    Choice choice;
    std::string_view meaning = {};
};

/// How direct light is found. mis: next event estimation and scattering combined; hemisphere: scattering
/// alone, the rendering equation over directions; area: next event estimation alone, the equation over
/// surfaces. What only one of them can find (a point light; a surface too large to be worth sampling) is
/// found in every mode.
enum class DirectLight : std::uint32_t {
    mis = kDirectMis,
    hemisphere = kDirectHemisphere,
    area = kDirectArea
};
constexpr auto namesOf(DirectLight) {
    return std::to_array<NamedChoice<DirectLight>>(
        {{"mis", DirectLight::mis, "lights and scattering combined"},
         {"hemisphere", DirectLight::hemisphere, "scattering alone"},
         {"area", DirectLight::area, "lights alone"}});
}

/// How mis weighs (Veach 1997): by the densities' squares or by the densities.
enum class MisHeuristic : std::uint32_t { power, balance };
constexpr auto namesOf(MisHeuristic) {
    return std::to_array<NamedChoice<MisHeuristic>>(
        {{"power", MisHeuristic::power}, {"balance", MisHeuristic::balance}});
}

/// How one light is picked of many: by a tree over where they are and whom they face, by their power, or all
/// alike.
enum class LightChoice : std::uint32_t { tree = kLightsTree, power = kLightsPower, uniform = kLightsUniform };
constexpr auto namesOf(LightChoice) {
    return std::to_array<NamedChoice<LightChoice>>({{"tree", LightChoice::tree, "near and facing first"},
                                                    {"power", LightChoice::power},
                                                    {"uniform", LightChoice::uniform}});
}

/// How a direction towards the environment is drawn; all three have the same density.
enum class EnvironmentSampling : std::uint32_t {
    alias = kEnvironmentAlias,
    inversion = kEnvironmentInversion,
    rejection = kEnvironmentRejection
};
constexpr auto namesOf(EnvironmentSampling) {
    return std::to_array<NamedChoice<EnvironmentSampling>>({{"inversion", EnvironmentSampling::inversion},
                                                            {"alias", EnvironmentSampling::alias},
                                                            {"rejection", EnvironmentSampling::rejection}});
}

/// Which samples: the low-discrepancy ones of an Owen-scrambled Sobol sequence, those of one whose errors are
/// blue noise over the picture, or independent ones.
enum class Sequence : std::uint32_t { sobol = kSamplerSobol, blue = kSamplerBlue, random = kSamplerRandom };
constexpr auto namesOf(Sequence) {
    return std::to_array<NamedChoice<Sequence>>(
        {{"sobol", Sequence::sobol, "Owen-scrambled"},
         {"blue", Sequence::blue, "errors spread as blue noise, for few samples"},
         {"random", Sequence::random}});
}

/// What a layer leaves to what lies below: what it does not reflect, by its directional albedo towards the
/// view alone or by those of both directions; or, by glTF's formula, 1 - F at the half vector.
enum class Layering : std::uint32_t { view = kLayeringView, albedo = kLayeringAlbedo, gltf = kLayeringGltf };
constexpr auto namesOf(Layering) {
    return std::to_array<NamedChoice<Layering>>(
        {{"view", Layering::view, "gives what it gets"},
         {"albedo", Layering::albedo, "so does that, and is reciprocal"},
         {"gltf", Layering::gltf, "reciprocal, but gains at grazing angles"}});
}

/// Whether light that one microfacet sends to another one is kept or lost.
enum class Energy : std::uint32_t { multiple = kEnergyMultiple, single = kEnergySingle };
constexpr auto namesOf(Energy) {
    return std::to_array<NamedChoice<Energy>>(
        {{"multiple", Energy::multiple}, {"single", Energy::single, "loses light where it is rough"}});
}

/// What is done about noise: nothing; what earlier views have told, brought to the present one; or that and a
/// filter over pixels that show one surface, whose share falls as the noise does; or, on the host, what a
/// network makes of the picture when its samples are there.
enum class Denoise : std::uint32_t { none, temporal, spatiotemporal, oidn };
constexpr auto namesOf(Denoise) {
    return std::to_array<NamedChoice<Denoise>>(
        {{"none", Denoise::none},
         {"temporal", Denoise::temporal, "earlier views of the same surfaces, where the camera moves"},
         {"spatiotemporal", Denoise::spatiotemporal, "that and neighbours that differ by no more than noise"},
         {"oidn", Denoise::oidn, "Open Image Denoise, which does not say how wrong it is"}});
}

/// How linear values become those of a display.
enum class Tonemap : std::uint32_t {
    none = kTonemapNone,
    neutral = kTonemapNeutral,
    agx = kTonemapAgx,
    aces = kTonemapAces
};
constexpr auto namesOf(Tonemap) {
    return std::to_array<NamedChoice<Tonemap>>({{"none", Tonemap::none},
                                                {"neutral", Tonemap::neutral},
                                                {"agx", Tonemap::agx},
                                                {"aces", Tonemap::aces}});
}

/// Whether paths go through queues (wavefront) or one kernel follows each from end to end (megakernel).
enum class QueueUse : std::uint32_t { on, off, automatic };
constexpr auto namesOf(QueueUse) {
    return std::to_array<NamedChoice<QueueUse>>(
        {{"on", QueueUse::on}, {"off", QueueUse::off}, {"auto", QueueUse::automatic, "where it pays"}});
}

constexpr auto namesOf(BvhQuality) {
    return std::to_array<NamedChoice<BvhQuality>>(
        {{"fast", BvhQuality::fast}, {"balanced", BvhQuality::balanced}, {"best", BvhQuality::best}});
}

/// All values of a choice.
template <typename Choice>
std::span<const NamedChoice<Choice>> choicesOf() {
    static constexpr auto names = namesOf(Choice{});
    return names;
}

template <typename Choice>
std::string_view nameOf(Choice choice) {
    const auto names = choicesOf<Choice>();
    const auto found = std::find_if(names.begin(), names.end(),
                                    [choice](const auto& known) { return known.choice == choice; });
    assert(found != names.end());
    return found->name;
}

/// "sobol (Owen-scrambled), blue or random"
template <typename Choice>
std::string listOf(std::span<const NamedChoice<Choice>> choices = choicesOf<Choice>()) {
    std::string list;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (i > 0) list += i + 1 == choices.size() ? " or " : ", ";
        list += choices[i].name;
        if (!choices[i].meaning.empty()) list.append(" (").append(choices[i].meaning).append(")");
    }
    return list;
}

}  // namespace licht
