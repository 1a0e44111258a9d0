// A picture or sky in OpenEXR's format.
#include "licht/image/exr.h"

#include "fuzz.h"
#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/core/memory.h"
#include "licht/image/files.h"

namespace licht::fuzz {

bool readInput(std::string_view bytes) {
    limitMemory(std::uint64_t{1} << 30U);
    const std::filesystem::path path = asFile("a.exr", bytes);
    try {
        readExr(path);
        readRadianceMap(path);
    } catch (const InputError&) {
        return false;
    }
    return true;
}

std::vector<std::string> seeds() {
    ExrPicture picture;
    picture.width = 5;
    picture.height = 3;
    std::vector<float> values(15);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.25F * static_cast<float>(i);
    for (const char* name : {"R", "G", "B", "variance.R"}) picture.channels.push_back({name, values});
    picture.attributes = {{"licht.scene", "a scene"}};
    const std::filesystem::path path = asFile("seed.exr", "");
    writeExr(path, picture);
    const std::vector<std::byte> bytes = readFile(path);
    return {std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())};
}

}  // namespace licht::fuzz
