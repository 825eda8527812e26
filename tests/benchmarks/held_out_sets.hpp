#ifndef TINWRIGHT_TESTS_BENCHMARKS_HELD_OUT_SETS_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_HELD_OUT_SETS_HPP

#include <functional>
#include <string>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"

#include "benchmarks/point_files.hpp"

/// Terrains of which a part is kept back, to see how well a surface through the rest foretells it.
namespace tinwright_benchmarks {

/// A surface is made of samples and lines, and read at the checks.
struct Fold {
    Points samples;
    std::vector<tinwright::Breakline> lines;
    Points checks;
};

struct HeldOutSet {
    enum class Kind {
        Real,      ///< measured terrain: the sets that targets are about
        Function,  ///< Franke's functions
        Extra      ///< told beside them
    };
    std::string name;
    Kind kind = Kind::Real;
    std::function<std::vector<Fold>()> make;  ///< seeded: the same whenever it is called
};

/// What can be made without files and of `samples_folder` (the project's samples/data), and with
/// `data_folder`, unless it is empty, of the data sets there. `scale`: of the numbers of samples and checks
/// where they are drawn; 1 for the figures of docs/interpolation.md.
std::vector<HeldOutSet> held_out_sets(const std::string& data_folder, const std::string& samples_folder,
                                      double scale);

/// Franke's test functions [franke1982], numbers 1 to 6, on the unit square.
double franke(int number, double x, double y);

}  // namespace tinwright_benchmarks

#endif
