#include "licht/image/exr_header.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

#include "licht/core/error.h"
#include "licht/core/one_line.h"

namespace licht {

// "OpenEXR File Layout": magic number and version, then attributes, each its name, its type, the size of its
// value and its value; an empty name ends them. Numbers have their lowest byte first.
void requireExrHeaderWithinFile(const std::filesystem::path& path) {
    constexpr std::int64_t kBeforeAttributes = 8;
    constexpr std::size_t kShown = 40;
    std::ifstream file(path, std::ios::binary);
    const auto length = static_cast<std::int64_t>(std::filesystem::file_size(path));
    file.seekg(kBeforeAttributes);
    std::string name;
    std::string type;
    std::array<char, 4> bytes{};
    while (std::getline(file, name, '\0') && !name.empty() && std::getline(file, type, '\0') &&
           file.read(bytes.data(), bytes.size())) {
        std::uint32_t size = 0;
        for (std::size_t i = 0; i < bytes.size(); ++i)
            size |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << 8U * i;
        if (std::int64_t{size} > length - static_cast<std::int64_t>(file.tellg()))
            throw InputError(fmt::format("{}: its header's attribute '{}' of {} bytes ends beyond the file",
                                         path.string(), oneLine(name, kShown), size));
        file.seekg(size, std::ios::cur);
    }
}

}  // namespace licht
