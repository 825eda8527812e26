#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/block_bootstrap.hpp"
#include "benchmarks/contenders.hpp"
#include "benchmarks/held_out_sets.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

namespace {

using Kind = HeldOutSet::Kind;

bool is_chosen(const std::string& name, const std::vector<std::string>& beginnings) {
    return beginnings.empty() ||
           std::any_of(beginnings.begin(), beginnings.end(),
                       [&](const std::string& beginning) { return name.starts_with(beginning); });
}

/// What the folds of a set say together.
struct Outcome {
    double samples = 0;  ///< of a fold, on average
    BlockErrors errors;
};

Outcome evaluate(const HeldOutSet& set, const std::vector<Contender>& contenders) {
    const std::vector<Fold> folds = set.make();
    Points checks;
    double samples = 0;
    for (const Fold& fold : folds) {
        checks.insert(checks.end(), fold.checks.begin(), fold.checks.end());
        samples += static_cast<double>(fold.samples.size());
    }
    Outcome outcome{samples / static_cast<double>(folds.size()), BlockErrors(checks, contenders.size())};
    for (const Fold& fold : folds) {
        const FoldErrors found = find_errors(fold, contenders);
        for (std::size_t i = 0; i < found.inside.size(); ++i) {
            const tinwright::Point3& check = fold.checks[found.inside[i]];
            outcome.errors.add({check.x, check.y}, found.errors[i]);
        }
    }
    return outcome;
}

/// Sums of logarithms of ratios to linear, to be geometric means.
struct Means {
    std::size_t sets = 0;
    std::vector<double> logarithms;
    std::vector<std::size_t> better;
    std::vector<std::size_t> worse;

    explicit Means(std::size_t contenders) : logarithms(contenders), better(contenders), worse(contenders) {}
    [[nodiscard]] double of(std::size_t contender) const {
        return std::exp(logarithms[contender] / static_cast<double>(sets));
    }
};

std::string cell(double ratio, const BlockErrors::Interval& interval) {
    const char* mark = interval.high < 1 ? " +" : interval.low > 1 ? " **-**" : "";
    return number(ratio) + mark;
}

/// The table's line of a set; linear is contender 0.
void add_row(const std::string& name, const Outcome& outcome, Means& means) {
    const double base = outcome.errors.rmse(0);
    std::printf("| %s | %.0f | %zu | %s |", name.c_str(), outcome.samples, outcome.errors.count(),
                number(base).c_str());
    ++means.sets;
    for (std::size_t c = 1; c < means.logarithms.size(); ++c) {
        const double ratio = outcome.errors.rmse(c) / base;
        const BlockErrors::Interval interval = outcome.errors.ratio_interval(c, 0);
        means.logarithms[c] += std::log(ratio);
        means.better[c] += interval.high < 1 ? 1 : 0;
        means.worse[c] += interval.low > 1 ? 1 : 0;
        std::printf(" %s |", cell(ratio, interval).c_str());
    }
    std::printf("\n");
    std::fflush(stdout);
}

void add_means(const std::string& name, const Means& means) {
    if (means.sets == 0) {
        return;
    }
    std::printf("| **%s**, geometric mean of %zu | | | |", name.c_str(), means.sets);
    for (std::size_t c = 1; c < means.logarithms.size(); ++c) {
        std::printf(" **%s** |", number(means.of(c)).c_str());
    }
    std::printf("\n| significantly better, worse | | | |");
    for (std::size_t c = 1; c < means.logarithms.size(); ++c) {
        std::printf(" %zu, %zu |", means.better[c], means.worse[c]);
    }
    std::printf("\n");
}

/// What is asked of the methods, of those that were measured.
class Verdicts {
  public:
    Verdicts(const std::vector<Contender>& contenders, const std::map<Kind, Means>& means)
        : contenders_(contenders), means_(means) {}

    void print() const {
        std::printf("\n");
        ResultTable table("RMSE, geometric means", "method", "compared with");
        add(table, Kind::Real, "real sets", "smooth", "linear", at_most(0.83));
        add(table, Kind::Real, "real sets", "smooth", "natural-neighbor", at_most(0.85));
        add(table, Kind::Function, "Franke's functions", "smooth", "linear", at_most(0.25));
        add(table, Kind::Real, "real sets", "natural-neighbor:c1", "linear", at_most(0.93));
        add(table, Kind::Real, "real sets", "clough-tocher", "linear", at_most(0.95));
        add(table, Kind::Real, "real sets", "linear@normal-angle", "linear", std::nullopt);
        add(table, Kind::Real, "real sets", "linear@normal-jump", "linear", std::nullopt);
        if (const std::optional<std::size_t> smooth = find("smooth")) {
            const auto worse = static_cast<double>(means_.at(Kind::Real).worse[*smooth] +
                                                   means_.at(Kind::Function).worse[*smooth] +
                                                   means_.at(Kind::Extra).worse[*smooth]);
            table.add("sets on which it is significantly worse", "smooth", "linear", worse, at_most(0));
        }
    }

  private:
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const {
        for (std::size_t c = 0; c < contenders_.size(); ++c) {
            if (contenders_[c].name == name) {
                return c;
            }
        }
        return std::nullopt;
    }

    void add(ResultTable& table, Kind kind, const std::string& sets, const std::string& method,
             const std::string& peer, std::optional<Target> target) const {
        const std::optional<std::size_t> ours = find(method);
        const std::optional<std::size_t> theirs = find(peer);
        if (ours && theirs && means_.at(kind).sets > 0) {
            table.add(sets, method, peer, means_.at(kind).of(*ours) / means_.at(kind).of(*theirs), target);
        }
    }

    const std::vector<Contender>& contenders_;
    const std::map<Kind, Means>& means_;
};

void measure(const Settings& settings) {
    const std::vector<Contender> contenders = contenders_of(settings.methods);
    const std::vector<std::string> chosen = split_list(settings.sets);
    std::printf("| set | samples | checks | linear: RMSE |");
    for (std::size_t c = 1; c < contenders.size(); ++c) {
        std::printf(" %s |", contenders[c].name.c_str());
    }
    std::printf("\n|---|---|---|---|");
    for (std::size_t c = 1; c < contenders.size(); ++c) {
        std::printf("---|");
    }
    std::printf("\n");
    std::map<Kind, Means> means;
    for (const auto& [kind, name] :
         {std::pair(Kind::Real, "real sets"), std::pair(Kind::Function, "Franke's functions"),
          std::pair(Kind::Extra, "more sets")}) {
        Means& of_kind = means.emplace(kind, contenders.size()).first->second;
        for (const HeldOutSet& set : held_out_sets(settings.data, TINWRIGHT_SAMPLES, settings.scale)) {
            if (set.kind == kind && is_chosen(set.name, chosen)) {
                add_row(set.name, evaluate(set, contenders), of_kind);
            }
        }
        add_means(name, of_kind);
    }
    Verdicts(contenders, means).print();
}

}  // namespace

void run_accuracy(const Settings& settings) {
    tbb::task_arena().execute([&] { measure(settings); });
}

}  // namespace tinwright_benchmarks
