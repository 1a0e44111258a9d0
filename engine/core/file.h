#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace licht {

/// The size in bytes of a regular file, known without opening it (opening a FIFO would wait for its writer).
/// Throws InputError naming the file when it is missing, a folder, or no regular file (device, FIFO).
std::uint64_t requireRegularFile(const std::filesystem::path& path);

/// Reads a whole regular file. Throws InputError naming the file when it is missing, a folder, no regular
/// file (device, FIFO), unreadable, or larger than max_bytes.
std::vector<std::byte> readFile(const std::filesystem::path& path,
                                std::uint64_t max_bytes = std::uint64_t{4} << 30U);

/// Whether both names lead to one file: by device and inode where the files exist, else by the folder's and
/// the name. False where one of them cannot be looked at.
bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// A file that appears under its name complete or not at all: it is written beside its destination and
/// renamed by commit(). Without commit() the destructor removes what was written and the old file stays
/// intact.
class AtomicFile {
public:
    /// Creates the temporary file at once, so that an unwritable destination is known early.
    /// Throws InputError when the destination is empty, a folder or a device, or its folder is missing or not
    /// writable.
    explicit AtomicFile(std::filesystem::path destination);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Where to write until commit(). Same folder, same ending as the destination.
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
    /// Flushes to disk and renames over the destination. Throws DeviceError (disk full and the like).
    void commit();

private:
    std::filesystem::path destination_;
    std::filesystem::path temporary_;
    bool committed_ = false;
};

/// Writes bytes through an AtomicFile.
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace licht
