// EXT_meshopt_compression: what meshoptimizer's own encoder writes is read back, and damaged streams end in
// one line.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <random>

#include "../support/gltf_file.h"
#include "licht/core/error.h"
#include "licht/scene/gltf.h"

namespace licht {
namespace {

using test::bytesOf;
using test::GltfFile;
using test::Json;
using test::TemporaryFolder;

constexpr const char* kExtension = "EXT_meshopt_compression";

std::string attributes(std::string_view decoded, std::size_t count) {
    const std::size_t stride = decoded.size() / count;
    std::string encoded(meshopt_encodeVertexBufferBound(count, stride), '\0');
    encoded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(encoded.data()),
                                              encoded.size(), decoded.data(), count, stride));
    return encoded;
}

std::string triangles(const std::vector<std::uint32_t>& indices) {
    std::string encoded(meshopt_encodeIndexBufferBound(indices.size(), indices.size()), '\0');
    encoded.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(encoded.data()), encoded.size(),
                                             indices.data(), indices.size()));
    return encoded;
}

std::string sequence(const std::vector<std::uint32_t>& indices) {
    std::string encoded(meshopt_encodeIndexSequenceBound(indices.size(), indices.size()), '\0');
    encoded.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(encoded.data()),
                                               encoded.size(), indices.data(), indices.size()));
    return encoded;
}

/// Buffer 0 holds what is compressed; buffer 1 is the fallback without bytes, as gltfpack writes it.
class CompressedFile : public GltfFile {
public:
    CompressedFile() { json["extensionsRequired"] = {kExtension}; }

    int compressedView(const std::string& encoded, std::size_t count, std::size_t stride, const char* mode,
                       const char* filter = nullptr) {
        const int plain = view(encoded);
        Json& v = json["bufferViews"][static_cast<std::size_t>(plain)];
        Json extension = v;
        extension["byteStride"] = stride;
        extension["count"] = count;
        extension["mode"] = mode;
        if (filter != nullptr) extension["filter"] = filter;
        v = {{"buffer", 1}, {"byteOffset", fallback_bytes_}, {"byteLength", count * stride}};
        v["extensions"][kExtension] = extension;
        fallback_bytes_ += count * stride;
        return plain;
    }

    int accessorOf(int buffer_view, int component_type, const char* type, std::size_t count) {
        return add("accessors",
                   {{"bufferView", buffer_view},
                    {"componentType", component_type},
                    {"count", count},
                    {"type", type},
                    {"normalized", component_type == test::kShort || component_type == test::kByte}});
    }

    std::filesystem::path write(const TemporaryFolder& folder) {
        json["buffers"] = Json::array({{{"byteLength", binary.size()}}, {{"byteLength", fallback_bytes_}}});
        json["buffers"][1]["extensions"][kExtension]["fallback"] = true;
        return writeGlb(folder);
    }

    Json& extension(std::size_t v) { return json["bufferViews"][v]["extensions"][kExtension]; }

private:
    std::size_t fallback_bytes_ = 0;
};

/// A grid with noise: its codes use every width of the format.
constexpr std::size_t kSide = 20;
constexpr std::size_t kVertices = kSide * kSide;

std::vector<float> positions() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> noise(-1.0F, 1.0F);
    std::vector<float> result;
    for (std::size_t i = 0; i < kVertices; ++i) {
        result.push_back(static_cast<float>(i % kSide));
        result.push_back(static_cast<float>(i / kSide));
        result.push_back(noise(random));
    }
    return result;
}

std::vector<std::uint32_t> indices() {
    constexpr auto side = static_cast<std::uint32_t>(kSide);
    std::vector<std::uint32_t> result;
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t i = y * side + x;
            for (const std::uint32_t corner : {i, i + 1, i + side, i + side, i + 1, i + 1 + side})
                result.push_back(corner);
        }
    }
    return result;
}

CompressedFile grid(bool as_triangles = true, std::size_t index_bytes = 2) {
    CompressedFile file;
    const std::string vertices = bytesOf(std::span<const float>(positions()));
    const int position_view =
        file.compressedView(attributes(vertices, kVertices), kVertices, 12, "ATTRIBUTES");
    const std::vector<std::uint32_t> list = indices();
    const int index_view = file.compressedView(as_triangles ? triangles(list) : sequence(list), list.size(),
                                               index_bytes, as_triangles ? "TRIANGLES" : "INDICES");
    const int p = file.accessorOf(position_view, test::kFloat, "VEC3", kVertices);
    const int i = file.accessorOf(index_view, index_bytes == 2 ? test::kUnsignedShort : test::kUnsignedInt,
                                  "SCALAR", list.size());
    file.mesh({{"attributes", {{"POSITION", p}}}, {"indices", i}});
    file.root({{"mesh", 0}});
    return file;
}

class Meshopt : public testing::Test {
protected:
    Mesh load(CompressedFile& file) { return loadGltf(file.write(folder_)).meshes.at(0); }

    std::string errorOf(CompressedFile& file) {
        try {
            loadGltf(file.write(folder_));
        } catch (const InputError& e) {
            return e.what();
        }
        return "it loaded";
    }

    TemporaryFolder folder_;
};

TEST_F(Meshopt, AttributesAndIndicesComeBackExactly) {
    const std::vector<float> expected = positions();
    const std::vector<std::uint32_t> corners = indices();
    for (const bool as_triangles : {true, false}) {
        for (const std::size_t index_bytes : {std::size_t{2}, std::size_t{4}}) {
            CompressedFile file = grid(as_triangles, index_bytes);
            const Mesh mesh = load(file);
            ASSERT_EQ(mesh.positions.size(), kVertices);
            for (std::size_t i = 0; i < kVertices; ++i) {
                EXPECT_EQ(mesh.positions[i], vec3(expected[3 * i], expected[3 * i + 1], expected[3 * i + 2]));
            }
            ASSERT_EQ(mesh.triangles.size(), corners.size() / 3);
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                // The codec for triangles may turn one round, which keeps its side.
                uvec3 a = mesh.triangles[t];
                const uvec3 b(corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]);
                for (int turn = 0; as_triangles && turn < 2 && a != b; ++turn) a = uvec3(a.y, a.z, a.x);
                EXPECT_EQ(a, b) << t;
            }
        }
    }
}

/// The encoder of exponents has had one argument more since version 0.19 of the library; its first value is
/// to encode each number by itself.
using OldEncoder = void (*)(void*, std::size_t, std::size_t, int, const float*);
[[maybe_unused]] void encodeExponents(OldEncoder encode, std::string& to, const std::vector<float>& from) {
    encode(to.data(), from.size(), sizeof(float), 24, from.data());
}
template <typename Mode>
void encodeExponents(void (*encode)(void*, std::size_t, std::size_t, int, const float*, Mode),
                     std::string& to, const std::vector<float>& from) {
    encode(to.data(), from.size(), sizeof(float), 24, from.data(), Mode{});
}

TEST_F(Meshopt, FiltersAreUndone) {
    CompressedFile file;
    // Exponential: 24 bits of mantissa hold these exactly.
    const std::vector<float> corners{0, 0, 0, 1.5F, 0, 0, 0, -0.625F, 1024};
    std::string exponential(36, '\0');
    encodeExponents(&meshopt_encodeFilterExp, exponential, corners);
    const int p =
        file.accessorOf(file.compressedView(attributes(exponential, 3), 3, 12, "ATTRIBUTES", "EXPONENTIAL"),
                        test::kFloat, "VEC3", 3);
    // Octahedral, 16 bits.
    const std::vector<float> normals{0, 0, 1, 0, 0.6F, 0, -0.8F, 0, -0.48F, 0.6F, 0.64F, 0};
    std::string octahedral(24, '\0');
    meshopt_encodeFilterOct(octahedral.data(), 3, 8, 16, normals.data());
    const int n =
        file.accessorOf(file.compressedView(attributes(octahedral, 3), 3, 8, "ATTRIBUTES", "OCTAHEDRAL"),
                        test::kShort, "VEC3", 3);
    file.json["bufferViews"][1]["byteStride"] = 8;
    // Quaternions; a colour shows what was decoded.
    const std::vector<float> quaternions{0.5F, 0.5F, 0.5F, 0.5F, 0.1F, 0.7F, 0.1F, 0.7F, 0, 0, 0.6F, 0.8F};
    std::string quaternion(24, '\0');
    meshopt_encodeFilterQuat(quaternion.data(), 3, 8, 16, quaternions.data());
    const int q =
        file.accessorOf(file.compressedView(attributes(quaternion, 3), 3, 8, "ATTRIBUTES", "QUATERNION"),
                        test::kShort, "VEC4", 3);
    file.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"COLOR_0", q}}}});
    file.root({{"mesh", 0}});
    const Mesh mesh = load(file);
    for (int i = 0; i < 3; ++i) {
        const auto v = static_cast<std::size_t>(i);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(mesh.positions[v][c], corners[3 * v + static_cast<std::size_t>(c)]);
            // Two 16-bit coordinates are off by 2^-16 each, their remainder by both, the result by 2^-16
            // again; normalising at most doubles it.
            EXPECT_NEAR(mesh.normals[v][c], normals[4 * v + static_cast<std::size_t>(c)], 8 * 0x1p-16F);
        }
        for (int c = 0; c < 4; ++c) {
            // Three components of 15 bits within sqrt(1/2), the fourth from them: x dx / w, three times, w >=
            // 1/2.
            EXPECT_NEAR(mesh.colors[v][c], quaternions[4 * v + static_cast<std::size_t>(c)], 6 * 0x1p-15F);
        }
    }
}

TEST_F(Meshopt, DamagedStreamsNameTheView) {
    const std::string decoder = "EXT_meshopt_compression: its ";
    CompressedFile cut = grid();
    cut.extension(0)["byteLength"] = cut.extension(0)["byteLength"].get<int>() - 1;
    EXPECT_NE(errorOf(cut).find("buffer view 0: " + decoder), std::string::npos) << errorOf(cut);
    CompressedFile version = grid();
    version.binary[0] = '\x5f';
    EXPECT_NE(errorOf(version).find("buffer view 0: " + decoder), std::string::npos) << errorOf(version);
    CompressedFile cut_indices = grid();
    cut_indices.extension(1)["byteLength"] = cut_indices.extension(1)["byteLength"].get<int>() - 1;
    EXPECT_NE(errorOf(cut_indices).find("buffer view 1: " + decoder), std::string::npos)
        << errorOf(cut_indices);
    // Flipped bits must never do more than that: another mesh or an error.
    std::mt19937 random(1);
    const CompressedFile sound = grid();
    for (int i = 0; i < 200; ++i) {
        CompressedFile flipped = sound;
        flipped.binary[random() % flipped.binary.size()] ^= static_cast<char>(1U << (random() % 8));
        EXPECT_NO_FATAL_FAILURE(errorOf(flipped));
    }
}

TEST_F(Meshopt, SizesAreCheckedBeforeAnythingIsDecoded) {
    const auto expect = [this](const char* key, const Json& value, const std::string& part,
                               std::size_t view = 0) {
        CompressedFile file = grid();
        if (value.is_null()) {
            file.extension(view).erase(key);
        } else {
            file.extension(view)[key] = value;
        }
        const std::string error = errorOf(file);
        EXPECT_NE(error.find("buffer view " + std::to_string(view) + ": EXT_meshopt_compression: "),
                  std::string::npos)
            << error;
        EXPECT_NE(error.find(part), std::string::npos) << error;
    };
    expect("buffer", 7, "buffer 7 is not there");
    expect("buffer", -1, "buffer is missing or no natural number");
    expect("buffer", 1, "reach beyond the 0 bytes of buffer 1");
    expect("byteOffset", 1U << 30U, "reach beyond");
    expect("byteOffset", UINT64_MAX, "reach beyond");
    expect("byteLength", UINT64_MAX, "reach beyond");
    expect("byteLength", nullptr, "byteLength is missing");
    expect("count", nullptr, "count is missing");
    expect("count", 1.5, "count is missing or no natural number");
    expect("count", UINT64_MAX, "cannot come out of");
    expect("count", UINT64_MAX / 12 + 1, "cannot come out of");
    expect("count", 100, "is not the view's byteLength");
    expect("count", 100, "no whole triangles", 1);
    expect("byteStride", 0, "does not allow a byteStride of 0");
    expect("byteStride", 10, "does not allow a byteStride of 10");
    expect("byteStride", 260, "does not allow a byteStride of 260");
    expect("byteStride", 3, "does not allow a byteStride of 3", 1);
    expect("mode", "LINES", "its mode 'LINES' is unknown");
    expect("mode", nullptr, "its mode '' is unknown");
    expect("filter", "BLUR", "its filter 'BLUR' is unknown");
    expect("filter", "OCTAHEDRAL", "filter OCTAHEDRAL does not go with");
    expect("filter", "QUATERNION", "filter QUATERNION does not go with");
    expect("filter", "EXPONENTIAL", "filter EXPONENTIAL does not go with mode TRIANGLES", 1);
}

TEST_F(Meshopt, AFallbackHasNoBytesOfItsOwn) {
    CompressedFile plain = grid();
    plain.json["bufferViews"][0].erase("extensions");
    EXPECT_NE(errorOf(plain).find("reaches beyond the 0 bytes of buffer 1"), std::string::npos)
        << errorOf(plain);

    CompressedFile unmarked = grid();
    const std::filesystem::path path = unmarked.write(folder_);
    unmarked.json["buffers"][1]["extensions"][kExtension]["fallback"] = false;
    unmarked.writeGlb(folder_);
    try {
        loadGltf(path);
        FAIL() << "it loaded";
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("buffer 1: it has neither a uri nor a binary chunk"),
                  std::string::npos)
            << e.what();
    }
}

}  // namespace
}  // namespace licht
