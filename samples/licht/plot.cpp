#include "samples/licht/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace licht {
namespace {

constexpr double kWidth = 720.0, kHeight = 420.0;
constexpr double kLeft = 70.0, kRight = 20.0, kTop = 40.0, kBottom = 50.0;
/// Told apart by those who see no red and green, too (Wong 2011, Points of view: Color blindness).
constexpr std::array kColours{"#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    void take(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
    /// 0 to 1.
    [[nodiscard]] double share(double value) const {
        return most > least ? (value - least) / (most - least) : 0.5;
    }
};

std::string label(double x, double y, const char* anchor, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                       escaped(text));
}

}  // namespace

std::string svgText(const Plot& plot) {
    Range xs, decades;
    for (const Curve& curve : plot.curves) {
        for (const auto& [x, y] : curve.points) {
            if (!(y > 0.0) || !std::isfinite(y)) continue;
            xs.take(x);
            decades.take(std::floor(std::log10(y)));
            decades.take(std::ceil(std::log10(y)));
        }
    }
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n",
        kWidth, kHeight);
    text += label(0.5 * kWidth, 0.6 * kTop, "middle", plot.title);
    text += label(0.5 * kWidth, kHeight - 0.2 * kBottom, "middle", plot.x);
    text += label(0.2 * kLeft, 0.8 * kTop, "start", plot.y);
    const auto across = [&](double x) { return kLeft + (kWidth - kLeft - kRight) * xs.share(x); };
    const auto down = [&](double decade) {
        return kHeight - kBottom - (kHeight - kTop - kBottom) * decades.share(decade);
    };
    for (double decade = decades.least; decade <= decades.most; decade += 1.0) {
        text += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#ccc\"/>\n", kLeft, down(decade),
                            kWidth - kRight);
        text += label(kLeft - 6.0, down(decade) + 4.0, "end", fmt::format("{:.3g}", std::pow(10.0, decade)));
    }
    if (xs.least <= xs.most)
        for (const double x : {xs.least, xs.most})
            text += label(across(x), kHeight - 0.6 * kBottom, "middle", fmt::format("{:.6g}", x));
    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
        const Curve& curve = plot.curves[i];
        const char* colour = kColours[i % kColours.size()];
        std::string line;
        for (const auto& [x, y] : curve.points)
            if (y > 0.0 && std::isfinite(y))
                line +=
                    fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", across(x), down(std::log10(y)));
        text +=
            fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n", line, colour);
        const double row = kTop + 16.0 * static_cast<double>(i + 1);
        text += fmt::format("<g fill=\"{}\">\n{}</g>\n", colour,
                            label(kWidth - kRight - 6.0, row, "end", curve.name));
    }
    return text + "</svg>\n";
}

}  // namespace licht
