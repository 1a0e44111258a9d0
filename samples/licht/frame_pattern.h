#pragma once
// Names of the files of a sequence.
#include <cstdint>
#include <filesystem>

namespace licht {

/// A name with one number in it, "%d" or, filled up with zeros to N places, "%0Nd" (N from 1 to 9).
class FramePattern {
public:
    /// Throws InputError naming it where it has no such number, another % or several.
    explicit FramePattern(const std::filesystem::path& pattern);
    [[nodiscard]] std::filesystem::path of(std::uint32_t frame) const;

private:
    std::string before_, behind_;
    int places_ = 0;
};

}  // namespace licht
