#pragma once
#include <filesystem>

namespace licht {

/// Throws InputError where an attribute of a flat file's header ends beyond the file: the library takes its
/// memory, up to two gigabytes, before it reads it. What else is wrong is left to the library.
void requireExrHeaderWithinFile(const std::filesystem::path& path);

}  // namespace licht
