#pragma once
// Names of the files of a sequence.
#include <cstdint>
#include <filesystem>

namespace licht {

/// A name with one number in it, "%d" or, filled up with zeros to N places, "%0Nd" (N from 1 to 9). All files
/// lie in one folder, whose name may have any characters.
class FramePattern {
public:
    /// Throws InputError naming it where the file's name has no such number, another % or several.
    explicit FramePattern(const std::filesystem::path& pattern);
    [[nodiscard]] std::filesystem::path of(std::uint32_t frame) const;

private:
    std::filesystem::path folder_;
    std::string before_, behind_;
    int places_ = 0;
};

}  // namespace licht
