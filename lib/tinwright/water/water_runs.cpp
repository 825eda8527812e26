#include "tinwright/water/water_runs.hpp"

#include <algorithm>

namespace tinwright {

namespace {

/// The runs of rivers in the open.
class RiverRuns {
  public:
    RiverRuns(WaterNetwork& network, const std::vector<bool>& is_in_water)
        : out_(network), is_piece_in_water_(is_in_water) {}

    void find() {
        const std::vector<std::uint32_t> ways = count_ways();
        for (std::uint32_t line = 0; line < out_.prepared.size(); ++line) {
            if (out_.prepared[line].role != LineRole::River) {
                continue;
            }
            WaterRun run;
            run.line = line;
            const auto finish = [&] {
                if (run.stops.size() > 1) {
                    run.from = out_.nearest_node(run.stops.front());
                    run.to = out_.nearest_node(run.stops.back());
                    out_.runs.push_back(run);
                }
                run.stops.clear();
            };
            const auto chain = out_.chain(line);
            double chainage = 0;
            for (std::size_t i = 0; i + 1 < chain.size();
                 chainage += out_.told_distance(chain[i], chain[i + 1]), ++i) {
                const std::uint32_t v = chain[i];
                const bool is_own = out_.node_of[v] != kNoNode && out_.node_of[v] >= out_.first_vertex;
                if (!is_own || ways[v] != 2) {
                    finish();
                }
                if (is_in_water(v, chain[i + 1], line)) {
                    finish();
                    continue;
                }
                if (run.stops.empty()) {
                    run.stops.push_back(v);
                    run.chainage = chainage;
                }
                run.stops.push_back(chain[i + 1]);
            }
            finish();
        }
    }

  private:
    [[nodiscard]] bool is_in_water(std::uint32_t a, std::uint32_t b, std::uint32_t line) const {
        const NodedPiece sought{std::min(a, b), std::max(a, b), line, 0};
        const auto place = std::lower_bound(out_.noded.pieces.begin(), out_.noded.pieces.end(), sought);
        return is_piece_in_water_[static_cast<std::size_t>(place - out_.noded.pieces.begin())];
    }

    /// How many different ways lead from each vertex along rivers in the open.
    std::vector<std::uint32_t> count_ways() const {
        std::vector<std::uint32_t> ways(out_.noded.keys.size());
        const NodedPiece* last = nullptr;
        for (std::size_t i = 0; i < out_.noded.pieces.size(); ++i) {
            const NodedPiece& piece = out_.noded.pieces[i];
            if (out_.prepared[piece.line].role != LineRole::River || is_piece_in_water_[i]) {
                continue;
            }
            if (last == nullptr || last->a != piece.a || last->b != piece.b) {
                ++ways[piece.a];
                ++ways[piece.b];
            }
            last = &piece;
        }
        return ways;
    }

    WaterNetwork& out_;
    const std::vector<bool>& is_piece_in_water_;
};

/// The runs of one polygon.
class BankRuns {
  public:
    BankRuns(WaterNetwork& network, std::uint32_t bank, const std::vector<bool>& is_stop)
        : out_(network),
          bank_(bank),
          links_(out_.banks[bank].network.links),
          is_stop_(is_stop),
          of_section_(out_.banks[bank].network.sections.size()),
          is_done_(links_.size()) {
        for (std::uint32_t l = 0; l < links_.size(); ++l) {
            of_section_[links_[l].a].push_back(l);
            of_section_[links_[l].b].push_back(l);
        }
    }

    void find() {
        for (std::uint32_t s = 0; s < of_section_.size(); ++s) {
            if (ends_run(s)) {
                for (const std::uint32_t link : of_section_[s]) {
                    follow(s, link);
                }
            }
        }
        for (std::uint32_t link = 0; link < links_.size(); ++link) {
            follow(links_[link].a, link);  // what is left goes round
        }
    }

  private:
    [[nodiscard]] bool ends_run(std::uint32_t section) const {
        return of_section_[section].size() != 2 || is_stop_[out_.banks[bank_].first_node + section];
    }

    void follow(std::uint32_t section, std::uint32_t link) {
        if (is_done_[link]) {
            return;
        }
        const std::uint32_t first_node = out_.banks[bank_].first_node;
        WaterRun run;
        run.line = out_.banks[bank_].polygon.rings.front();
        run.is_between_banks = true;
        run.bank = bank_;
        run.stops.push_back(first_node + section);
        for (;;) {
            is_done_[link] = true;
            const bool is_forward = links_[link].a == section;
            run.paths.push_back(links_[link].path);
            if (!is_forward) {
                std::reverse(run.paths.back().begin(), run.paths.back().end());
            }
            section = is_forward ? links_[link].b : links_[link].a;
            run.stops.push_back(first_node + section);
            if (ends_run(section)) {
                break;
            }
            const std::vector<std::uint32_t>& ways = of_section_[section];
            link = ways[0] == link ? ways[1] : ways[0];
            if (is_done_[link]) {
                break;
            }
        }
        run.from = run.stops.front();
        run.to = run.stops.back();
        out_.runs.push_back(std::move(run));
    }

    WaterNetwork& out_;
    std::uint32_t bank_;
    const std::vector<BankLink>& links_;
    const std::vector<bool>& is_stop_;
    std::vector<std::vector<std::uint32_t>> of_section_;
    std::vector<bool> is_done_;
};

}  // namespace

void find_runs(WaterNetwork& network, const std::vector<bool>& is_in_water) {
    RiverRuns(network, is_in_water).find();
    // Sections in a row go up to where more or fewer than two ways lead on, or rivers come in.
    std::vector<bool> is_stop(network.node_count);
    for (const WaterRun& run : network.runs) {
        is_stop[run.from] = is_stop[run.to] = true;
    }
    for (const auto& [a, b] : network.equal) {
        is_stop[a] = is_stop[b] = true;
    }
    for (std::uint32_t b = 0; b < network.banks.size(); ++b) {
        BankRuns(network, b, is_stop).find();
    }
}

}  // namespace tinwright
