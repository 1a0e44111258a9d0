#pragma once
#include <random>
#include <span>
#include <string>

namespace licht::fuzz {

/// A damaged copy of one of the seeds: up to eight bits, bytes, words, numbers in text or stretches changed,
/// moved, taken out or put in from another seed. The same random numbers give the same bytes.
std::string damaged(std::span<const std::string> seeds, std::mt19937_64& random);

}  // namespace licht::fuzz
