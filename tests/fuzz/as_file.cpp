#include <fstream>

#include "../support/gltf_file.h"
#include "fuzz.h"

namespace licht::fuzz {

std::filesystem::path asFile(const std::string& name, std::string_view bytes) {
    static const test::TemporaryFolder folder;
    return folder.write(name, bytes);
}

}  // namespace licht::fuzz
