#include "licht/settings/choices.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace licht {
namespace {

constexpr auto kTonemapNames = std::to_array<NamedChoice<Tonemap>>(
    {{"none", Tonemap::none}, {"neutral", Tonemap::neutral}, {"agx", Tonemap::agx}, {"aces", Tonemap::aces}});
constexpr auto kQueueUseNames = std::to_array<NamedChoice<QueueUse>>(
    {{"auto", QueueUse::automatic}, {"on", QueueUse::on}, {"off", QueueUse::off}});
constexpr auto kBvhQualityNames = std::to_array<NamedChoice<BvhQuality>>(
    {{"fast", BvhQuality::fast}, {"balanced", BvhQuality::balanced}, {"best", BvhQuality::best}});
constexpr auto kDirectLightNames = std::to_array<NamedChoice<DirectLight>>(
    {{"mis", DirectLight::mis}, {"hemisphere", DirectLight::hemisphere}, {"area", DirectLight::area}});
constexpr auto kMisHeuristicNames = std::to_array<NamedChoice<MisHeuristic>>(
    {{"power", MisHeuristic::power}, {"balance", MisHeuristic::balance}});
constexpr auto kLightChoiceNames = std::to_array<NamedChoice<LightChoice>>(
    {{"tree", LightChoice::tree}, {"power", LightChoice::power}, {"uniform", LightChoice::uniform}});
constexpr auto kEnvironmentSamplingNames =
    std::to_array<NamedChoice<EnvironmentSampling>>({{"alias", EnvironmentSampling::alias},
                                                     {"inversion", EnvironmentSampling::inversion},
                                                     {"rejection", EnvironmentSampling::rejection}});
constexpr auto kSequenceNames = std::to_array<NamedChoice<Sequence>>(
    {{"sobol", Sequence::sobol}, {"blue", Sequence::blue}, {"random", Sequence::random}});

}  // namespace

template <>
std::span<const NamedChoice<Tonemap>> choicesOf() {
    return kTonemapNames;
}
template <>
std::span<const NamedChoice<QueueUse>> choicesOf() {
    return kQueueUseNames;
}
template <>
std::span<const NamedChoice<BvhQuality>> choicesOf() {
    return kBvhQualityNames;
}
template <>
std::span<const NamedChoice<DirectLight>> choicesOf() {
    return kDirectLightNames;
}
template <>
std::span<const NamedChoice<MisHeuristic>> choicesOf() {
    return kMisHeuristicNames;
}
template <>
std::span<const NamedChoice<LightChoice>> choicesOf() {
    return kLightChoiceNames;
}
template <>
std::span<const NamedChoice<EnvironmentSampling>> choicesOf() {
    return kEnvironmentSamplingNames;
}
template <>
std::span<const NamedChoice<Sequence>> choicesOf() {
    return kSequenceNames;
}

template <typename Choice>
std::string_view nameOf(Choice choice) {
    const auto names = choicesOf<Choice>();
    const auto found = std::find_if(names.begin(), names.end(),
                                    [choice](const auto& known) { return known.choice == choice; });
    assert(found != names.end());
    return found->name;
}

template std::string_view nameOf(Tonemap);
template std::string_view nameOf(QueueUse);
template std::string_view nameOf(BvhQuality);
template std::string_view nameOf(DirectLight);
template std::string_view nameOf(MisHeuristic);
template std::string_view nameOf(LightChoice);
template std::string_view nameOf(EnvironmentSampling);
template std::string_view nameOf(Sequence);

}  // namespace licht
