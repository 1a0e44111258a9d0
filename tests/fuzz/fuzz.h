#pragma once
// What every target gives: how its input is read, and good inputs to start from. driver.cpp runs it on a
// fixed number of damaged ones, libfuzzer.cpp under libFuzzer.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace licht::fuzz {

/// Reads these bytes as what the target is for; returns whether they were taken. That they are refused
/// (InputError) is well; whatever else is thrown, a crash, a hang or a scene that is not sound, is a fault.
bool readInput(std::string_view bytes);
std::vector<std::string> seeds();

/// The bytes as a file of that name, in a folder that is this process's own and goes with it.
std::filesystem::path asFile(const std::string& name, std::string_view bytes);

}  // namespace licht::fuzz
