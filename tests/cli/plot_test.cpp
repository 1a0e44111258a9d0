#include "samples/licht/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace licht {
namespace {

using Points = std::vector<std::pair<double, double>>;

/// Where each curve's line goes, in units of the picture, y downward.
std::vector<Points> linesOf(const std::string& svg) {
    std::vector<Points> lines;
    const std::regex path(R"rule(<path d="([^"]*)" fill="none")rule");
    const std::regex point(R"([ML]([0-9.-]+) ([0-9.-]+))");
    for (auto at = std::sregex_iterator(svg.begin(), svg.end(), path); at != std::sregex_iterator(); ++at) {
        const std::string text = (*at)[1];
        Points& line = lines.emplace_back();
        for (auto p = std::sregex_iterator(text.begin(), text.end(), point); p != std::sregex_iterator(); ++p)
            line.emplace_back(std::stod((*p)[1]), std::stod((*p)[2]));
    }
    return lines;
}

bool has(const std::string& svg, const std::string& text) {
    return svg.find(text) != std::string::npos;
}

// Coordinates are written to a tenth.
constexpr double kTolerance = 0.1;

TEST(Plot, EqualFactorsAreEqualDistances) {
    const std::string svg = svgText({"t", "x", "y", {{"c", {{0, 1e-3}, {1, 1e-2}, {3, 1e-1}, {4, 10}}}}});
    const std::vector<Points> lines = linesOf(svg);
    ASSERT_EQ(lines.size(), 1U);
    const Points& line = lines[0];
    ASSERT_EQ(line.size(), 4U);
    const double decade = line[0].second - line[1].second;
    EXPECT_GT(decade, 0.0) << "more is higher";
    EXPECT_NEAR(line[1].second - line[2].second, decade, kTolerance);
    EXPECT_NEAR(line[2].second - line[3].second, 2 * decade, 2 * kTolerance);
    const double step = line[1].first - line[0].first;
    EXPECT_GT(step, 0.0);
    EXPECT_NEAR(line[2].first - line[1].first, 2 * step, 2 * kTolerance);
    EXPECT_NEAR(line[3].first - line[2].first, step, kTolerance);
    for (const char* decade_name : {">0.001<", ">0.01<", ">0.1<", ">1<", ">10<"})
        EXPECT_TRUE(has(svg, decade_name)) << decade_name;
}

TEST(Plot, AxesHoldWholeDecadesOfAllCurves) {
    const std::string svg =
        svgText({"t", "x", "y", {{"a", {{0, 0.2}, {9, 0.3}}}, {"b", {{0, 20}, {9, 30}}}}});
    for (const char* decade : {">0.1<", ">1<", ">10<", ">100<"}) EXPECT_TRUE(has(svg, decade)) << decade;
    EXPECT_FALSE(has(svg, ">0.01<") || has(svg, ">1e+03<"));
    const std::vector<Points> lines = linesOf(svg);
    ASSERT_EQ(lines.size(), 2U);
    // From 0.1 to 100, three decades: a hundred times higher is two thirds of the axis.
    const double two_thirds = lines[0][0].second - lines[1][0].second;
    EXPECT_NEAR(lines[0][1].second - lines[1][1].second, two_thirds, 2 * kTolerance);
    EXPECT_NEAR(lines[0][0].second - lines[0][1].second, std::log10(1.5) / 2.0 * two_thirds, 2 * kTolerance);
}

TEST(Plot, LeavesOutWhatHasNoLogarithm) {
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Points good{{0, 1}, {5, 2}};
    Points bad = good;
    bad.insert(bad.begin() + 1, {{1, 0.0}, {2, -1.0}, {3, inf}, {4, nan}});
    bad.insert(bad.end(), {{-100, 0.0}, {100, nan}});
    EXPECT_EQ(svgText({"t", "x", "y", {{"c", bad}}}), svgText({"t", "x", "y", {{"c", good}}}));
}

TEST(Plot, NothingToDrawIsStillAPicture) {
    for (const Points& points : {Points{}, Points{{0, 0.0}}, Points{{3, 1.0}}, Points{{0, 1.0}, {1, 1.0}}}) {
        const std::string svg = svgText({"t", "x", "y", {{"c", points}}});
        EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
        EXPECT_FALSE(has(svg, "nan") || has(svg, "inf")) << svg;
    }
    EXPECT_TRUE(svgText({"t", "x", "y", {}}).ends_with("</svg>\n"));
}

TEST(Plot, NamesStayText) {
    const std::string svg = svgText({"a<b & c>d", "<x>", "&y", {{"</g>", {{0, 1}}}}});
    for (const char* text : {">a&lt;b &amp; c&gt;d<", ">&lt;x&gt;<", ">&amp;y<", ">&lt;/g&gt;<"})
        EXPECT_TRUE(has(svg, text)) << text << "\n" << svg;
}

TEST(Plot, CurvesDiffer) {
    const std::string svg = svgText({"t", "x", "y", {{"one", {{0, 1}}}, {"two", {{0, 1}}}}});
    const std::regex colour(R"rule(stroke="(#\w+)" stroke-width)rule");
    std::sregex_iterator at(svg.begin(), svg.end(), colour);
    const std::string first = (*at)[1];
    const std::string second = (*++at)[1];
    EXPECT_NE(first, second);
    for (const std::string& named : {first, second}) EXPECT_TRUE(has(svg, "<g fill=\"" + named + "\">"));
}

}  // namespace
}  // namespace licht
