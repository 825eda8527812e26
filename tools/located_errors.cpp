#include "located_errors.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tinwright/geometry/error.hpp"

#include "line_points.hpp"

namespace tinwright::tools {

namespace {

/// `message` with the first few of the places it is about.
std::string located(const std::string& message, const std::vector<std::string>& places) {
    constexpr std::size_t kNamed = 3;
    std::string text = message;
    for (std::size_t i = 0; i < std::min(places.size(), kNamed); ++i) {
        text += (i == 0 ? " (" : "; ") + places[i];
    }
    if (places.size() > kNamed) {
        text += "; and " + std::to_string(places.size() - kNamed) + " more";
    }
    return places.empty() ? text : text + ")";
}

/// The names of samples and lines in messages.
class PlaceNames {
  public:
    PlaceNames(const io::Samples& samples, const io::Lines& lines)
        : samples_(samples), lines_(lines), line_points_(lines.lines) {}

    [[nodiscard]] std::vector<std::string> of_points(const std::vector<std::size_t>& points) const {
        std::vector<std::string> places;
        places.reserve(points.size());
        for (const std::size_t point : points) {
            places.push_back(of_point(point));
        }
        return distinct(std::move(places));
    }
    [[nodiscard]] std::vector<std::string> of_lines(const std::vector<std::size_t>& lines) const {
        std::vector<std::string> places;
        places.reserve(lines.size());
        for (const std::size_t line : lines) {
            places.push_back(lines_.describe(line));
        }
        return distinct(std::move(places));
    }

  private:
    static std::vector<std::string> distinct(std::vector<std::string> places) {
        places.erase(std::unique(places.begin(), places.end()), places.end());
        return places;
    }
    [[nodiscard]] std::string of_point(std::size_t point) const {
        if (point < samples_.points.size()) {
            return samples_.describe(point);
        }
        const auto line = line_points_.find_line(point - samples_.points.size());
        return line ? lines_.describe(*line) : "point " + std::to_string(point);
    }

    const io::Samples& samples_;
    const io::Lines& lines_;
    LinePoints line_points_;
};

}  // namespace

void run_located(const io::Samples& samples, const io::Lines& lines, const std::function<void()>& work) {
    const PlaceNames names(samples, lines);
    try {
        work();
    } catch (const DuplicateError& error) {
        std::vector<std::size_t> first;
        if (!error.first().empty()) {
            first = error.first().front().samples;
        }
        throw InputError(located(error.what(), names.of_points(first)), first);
    } catch (const BreaklineError& error) {
        std::vector<std::string> places = names.of_lines(error.lines());
        const std::vector<std::string> of_samples = names.of_points(error.samples());
        places.insert(places.end(), of_samples.begin(), of_samples.end());
        throw InputError(located(error.what(), places), error.samples());
    } catch (const InputError& error) {
        throw InputError(located(error.what(), names.of_points(error.samples())), error.samples());
    }
}

}  // namespace tinwright::tools
