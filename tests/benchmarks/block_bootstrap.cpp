#include "benchmarks/block_bootstrap.hpp"

#include <algorithm>
#include <cmath>

#include "tinwright/geometry/box.hpp"

#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

BlockErrors::BlockErrors(std::span<const tinwright::Point3> places, std::size_t contenders)
    : contenders_(contenders) {
    constexpr double kBlocks = 100;
    tinwright::Box box;
    for (const tinwright::Point3& place : places) {
        box.add(place.x, place.y);
    }
    if (box.is_empty()) {
        return;
    }
    const double width = box.x_max - box.x_min;
    const double height = box.y_max - box.y_min;
    x_min_ = box.x_min;
    y_min_ = box.y_min;
    side_ = std::max(std::sqrt(width * height / kBlocks), std::max(width, height) / kBlocks);
    columns_ = static_cast<std::size_t>(width / side_) + 1;
    blocks_.resize(columns_ * (static_cast<std::size_t>(height / side_) + 1));
}

void BlockErrors::add(tinwright::Point2 place, std::span<const double> errors) {
    const auto column = static_cast<std::size_t>((place.x - x_min_) / side_);
    const auto row = static_cast<std::size_t>((place.y - y_min_) / side_);
    Block& block = blocks_[row * columns_ + column];
    block.squares.resize(contenders_);
    ++block.count;
    for (std::size_t i = 0; i < contenders_; ++i) {
        block.squares[i] += errors[i] * errors[i];
    }
}

std::size_t BlockErrors::count() const {
    std::size_t count = 0;
    for (const Block& block : blocks_) {
        count += block.count;
    }
    return count;
}

double BlockErrors::sum(std::size_t contender) const {
    double sum = 0;
    for (const Block& block : blocks_) {
        sum += block.count > 0 ? block.squares[contender] : 0;
    }
    return sum;
}

double BlockErrors::rmse(std::size_t contender) const {
    return std::sqrt(sum(contender) / static_cast<double>(count()));
}

BlockErrors::Interval BlockErrors::ratio_interval(std::size_t contender, std::size_t base) const {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        if (blocks_[i].count > 0) {
            used.push_back(i);
        }
    }
    if (used.empty()) {
        return {};
    }
    tinwright_tests::Random random(1);
    std::vector<double> ratios;
    for (int draw = 0; draw < kDraws; ++draw) {
        double ours = 0;
        double theirs = 0;
        for (std::size_t i = 0; i < used.size(); ++i) {
            const auto pick =
                static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(used.size()) - 1));
            ours += blocks_[used[pick]].squares[contender];
            theirs += blocks_[used[pick]].squares[base];
        }
        ratios.push_back(std::sqrt(ours / theirs));
    }
    std::sort(ratios.begin(), ratios.end());
    const std::size_t tail = ratios.size() / 40;
    return {ratios[tail], ratios[ratios.size() - 1 - tail]};
}

}  // namespace tinwright_benchmarks
