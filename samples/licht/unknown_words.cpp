#include "samples/licht/unknown_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace licht {

std::size_t editDistance(std::string_view a, std::string_view b) {
    // Of each start of b from the starts of a that are two, one and no letter shorter.
    std::vector<std::size_t> two_less(b.size() + 1);
    std::vector<std::size_t> one_less(b.size() + 1);
    std::vector<std::size_t> now(b.size() + 1);
    std::iota(now.begin(), now.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(two_less, one_less);
        std::swap(one_less, now);
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = one_less[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U);
            now[j] = std::min({changed, one_less[j] + 1, now[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], two_less[j - 2] + 1);
        }
    }
    return now[b.size()];
}

std::string_view nearestOption(std::string_view word, std::span<const std::string> options) {
    constexpr std::size_t kFewestLetters = 5;  // of a start, its dashes included
    if (word.size() >= kFewestLetters)
        for (const std::string& option : options)
            if (option.starts_with(word)) return option;
    std::string_view nearest;
    std::size_t least = std::min<std::size_t>(2, word.size() / 3);
    for (const std::string& option : options) {
        const std::size_t distance = editDistance(word, option);
        if (distance > least || (distance == least && !nearest.empty())) continue;
        nearest = option;
        least = distance;
    }
    return nearest;
}

std::string describeUnknown(std::span<const std::string> unknown, std::span<const std::string> options) {
    std::string named;
    std::string others;
    for (const std::string& word : unknown) {
        if (!word.starts_with('-')) {
            others += fmt::format("{}'{}'", others.empty() ? "" : ", ", word);
            continue;
        }
        const std::string option = word.substr(0, word.find('='));
        const std::string_view meant = nearestOption(option, options);
        named += fmt::format("{}{}{}", named.empty() ? "" : ", ", option,
                             meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant));
    }
    return named.empty() ? "unexpected: " + others : "unknown: " + named;
}

}  // namespace licht
