#pragma once
// What a command gives away: text on the standard streams, and files.
#include <filesystem>
#include <span>
#include <string_view>

namespace licht {

/// Descriptors 0 to 2 that are closed are given to devices, so that no file takes their place and gets what
/// is meant for the terminal; a stream that cannot be written to ends no run by a signal.
void secureStandardStreams();

/// Text for standard output, flushed.
void printOut(std::string_view text);
/// Whether any of it got lost.
bool lostOutput();
/// Text for standard error. There is nowhere to say that it got lost.
void printError(std::string_view text);

/// Fails before the work is done when a file could not be written afterwards. Throws InputError.
void checkWritable(const std::filesystem::path& path);
/// Throws InputError where an output is one of the inputs, or one of the outputs before it.
void requireOwnFiles(std::span<const std::filesystem::path> outputs,
                     std::span<const std::filesystem::path> inputs);
/// Where nobody named the file: throws InputError where there is one that is no picture of Licht's.
void requireNoStranger(const std::filesystem::path& picture);

}  // namespace licht
