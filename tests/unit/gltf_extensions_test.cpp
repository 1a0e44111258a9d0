// The list of extensions against what the README says, what slots ask for, and what the loader does.
#include "licht/scene/gltf_extensions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "../support/gltf_file.h"
#include "licht/core/error.h"
#include "licht/scene/gltf.h"
#include "licht/scene/slot_table.h"

namespace licht {
namespace {

/// "KHR_materials_{ior, unlit}" names two.
std::set<std::string> namedIn(const std::string& text) {
    std::set<std::string> names;
    const std::regex pattern(R"(\b((?:KHR|EXT)_\w*)(?:\{([^}]*)\})?)");
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
        if (!(*it)[2].matched) {
            names.insert((*it)[1]);
            continue;
        }
        const std::string list = (*it)[2];
        const std::regex word(R"(\w+)");
        for (std::sregex_iterator w(list.begin(), list.end(), word); w != end; ++w)
            names.insert((*it)[1].str() + w->str());
    }
    return names;
}

TEST(GltfExtensions, TheReadmeNamesEachAndNoOther) {
    const auto file = std::filesystem::path(LICHT_SOURCE) / "README.md";
    std::ifstream stream(file);
    ASSERT_TRUE(stream) << file;
    std::stringstream text;
    text << stream.rdbuf();
    EXPECT_EQ(namedIn(text.str()), std::set<std::string>(kGltfExtensions.begin(), kGltfExtensions.end()));
}

TEST(GltfExtensions, SlotsComeFromThem) {
    for (const SlotInfo& info : kSlotTable) {
        if (!info.extension.empty()) {
            EXPECT_TRUE(knowsGltfExtension(info.extension)) << info.extension;
        }
    }
}

TEST(GltfExtensions, EachMayBeRequiredAndOthersMayNot) {
    const test::TemporaryFolder folder;
    const auto load = [&](std::string_view extension) {
        test::GltfFile file = test::GltfFile::triangle();
        file.json["extensionsUsed"] = {extension};
        file.json["extensionsRequired"] = {extension};
        return loadGltf(file.writeGlb(folder));
    };
    for (const std::string_view extension : kGltfExtensions) {
        EXPECT_TRUE(load(extension).notes.empty()) << extension;
    }
    EXPECT_THROW(load("KHR_not_there"), InputError);
}

}  // namespace
}  // namespace licht
