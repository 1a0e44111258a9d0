// The frame around a normal is orthonormal to 1e-6, also where formulas for it break: at -Z and beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "licht/spirv/frames_comp.h"
#include "shader/kernel.h"
#include "unit/bvh_meshes.h"

namespace licht {
namespace {

TEST(Frames, AreOrthonormalEverywhere) {
    struct Push {
        std::uint32_t count;
    };
    std::vector<vec4> normals;
    const float beside = std::nextafter(-1.0F, 0.0F);
    for (const float z : {-1.0F, beside, std::nextafter(beside, 0.0F), 1.0F}) {
        const float x = std::sqrt(std::max(0.0F, 1.0F - z * z));
        for (const float zero : {0.0F, -0.0F}) {
            normals.emplace_back(x, zero, z, 0);
            normals.emplace_back(-x, zero, z, 0);
            normals.emplace_back(zero, x, z, 0);
        }
    }
    for (const float zero : {0.0F, -0.0F, 1e-20F, -1e-20F}) {  // on the equator, where the sign of z decides
        normals.emplace_back(1, 0, zero, 0);
        normals.emplace_back(zero, -1, zero, 0);
    }
    test::Random random(1);
    for (int i = 0; i < 100'000; ++i) {
        // Closer and closer to -Z.
        vec3 n = random.direction();
        n = glm::normalize(vec3(n.x, n.y, 0) * std::ldexp(1.0F, -i % 24) +
                           vec3(0, 0, i % 3 == 0 ? n.z : -1.0F));
        normals.emplace_back(n, 0);
    }
    const auto count = static_cast<std::uint32_t>(normals.size());
    const std::vector<vec4> axes =
        test::Kernel("frames", frames_comp).run<vec4>(count, 2 * normals.size(), Push{count}, normals);
    double worst = 0.0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 n(normals[i]);
        const glm::dvec3 t(axes[2 * i]);
        const glm::dvec3 b(axes[2 * i + 1]);
        for (const double error : {glm::dot(t, n), glm::dot(b, n), glm::dot(t, b), glm::length(t) - 1.0,
                                   glm::length(b) - 1.0, glm::dot(glm::cross(t, b), n) - 1.0}) {
            ASSERT_TRUE(std::isfinite(error)) << i;
            worst = std::max(worst, std::abs(error));
        }
    }
    std::cout << "largest error " << worst << '\n';
    EXPECT_LE(worst, 1e-6);
}

}  // namespace
}  // namespace licht
