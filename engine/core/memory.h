#pragma once
// How much memory a run may take. What a file or an option implies is summed up and asked for here before
// anything of it is allocated: systems that promise more memory than they have end a program without a word.
#include <cstdint>
#include <string>
#include <string_view>

namespace licht {

/// Bytes of this process that are in memory now; 0 where the system does not tell.
std::uint64_t memoryInUse();

/// The most bytes that this process may have in memory: what was set, or else, from the first question on,
/// what it had then and most of what the machine could still give.
std::uint64_t memoryLimit();
void limitMemory(std::uint64_t bytes);

/// Throws InputError "<what> about 5.3 GiB, ..." with all numbers where so many bytes more would exceed the
/// limit. `what` ends in a verb: "scene.gltf: its 3 textures take". A double, because sums of what files
/// claim must not wrap.
void requireMemory(double bytes, std::string_view what);

/// "5.3 GiB", "12 MiB": powers of 1024.
std::string bytesInWords(double bytes);

}  // namespace licht
