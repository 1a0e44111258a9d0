#pragma once
#include <string>
#include <vector>

#include "../support/gltf_file.h"

namespace licht::fuzz {

/// A PNG and a JPEG of a few texels.
std::string smallPng();
std::string smallJpeg();

/// Files that between them have all that the loader reads.
std::vector<test::GltfFile> goodFiles();

/// Loads and, where it is taken, demands that it is sound; returns whether it was.
bool loadScene(const std::filesystem::path& path, bool strict = false);

}  // namespace licht::fuzz
