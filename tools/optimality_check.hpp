#ifndef TINWRIGHT_TOOLS_OPTIMALITY_CHECK_HPP
#define TINWRIGHT_TOOLS_OPTIMALITY_CHECK_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/io/read_tin.hpp"
#include "tinwright/optimal/certificate.hpp"

#include "json_value.hpp"
#include "length_check.hpp"
#include "parse_options.hpp"

/// Proving the TIN of a file optimal again, for `tinwright check --criterion`.
namespace tinwright::tools {

/// What is to be proven, of how many faces.
struct OptimalityOptions {
    std::string criterion_text;  ///< empty: nothing
    std::string norm_text;
    std::string worst_text;
    std::string reach_text;
    bool all = false;

    // After `finish`:
    std::optional<Criterion> criterion;
    std::optional<Norm> norm;          ///< for length; empty: as the file says
    std::optional<std::size_t> worst;  ///< empty: a hundred, or what the scope promises
    std::optional<std::size_t> reach;  ///< empty: without limit

    void add_to(CLI::App& parser);
    /// Throws UsageError.
    void finish();

  private:
    void refuse_others_options() const;
};

/// A face that is not as good as can be.
struct ImprovableFace {
    std::int64_t face = 0;  ///< feature id
    Point3 from;            ///< one end of the edge that improves it: a corner of the face
    Point3 to;
    double measure = 0;   ///< in the criterion's unit
    double improved = 0;  ///< the worst face that would replace it
};

/// What is found in one file.
struct OptimalityReport {
    /// Improvable faces that are listed; the rest is counted only.
    static constexpr std::size_t kListed = 1000;

    Criterion criterion = Criterion::Slope;
    std::string scope;           ///< under which the file says that it was made for this criterion; or empty
    bool is_unfinished = false;  ///< the file says that a budget or an interrupt ended its optimising
    std::size_t faces = 0;       ///< of the TIN
    std::optional<std::size_t> reach;
    Certificate certificate;  ///< with slots as faces, which mean nothing outside
    /// The face after those examined can be improved, which the scope does not rule out.
    bool is_next_improvable = false;
    /// Of length the longest edge, with a face that has it.
    std::vector<ImprovableFace> listed;
    std::optional<LengthCheck> length;  ///< for length, which knows nothing of the above but `criterion`

    [[nodiscard]] std::size_t improvable() const {
        return length ? listed.size() : certificate.improvements.size();
    }
};

/// Examines as many of the worst faces as `options` say. If they do not, a hundred: of scope `above` only
/// those beyond its value, and of `max` and `top`, which promise no more than the worst face, down to the
/// first that can be improved. Of length, the longest edge alone. `file`: without violations; `z_factor`: CRS
/// units in its unit of z. Throws InputError, Cancelled.
OptimalityReport check_optimality(const io::TinFile& file, const OptimalityOptions& options,
                                  const Progress& progress, double z_factor = 1);

/// "slope: the 100 worst of 5998 faces cannot be improved (1234 edges tried); worst 1.2, interior 0.9".
std::string optimality_verdict(const OptimalityReport& report);
/// One line a listed face, each beginning with the file's name.
std::string improvable_lines(const OptimalityReport& report, const std::string& file);
JsonValue optimality_json(const OptimalityReport& report);

}  // namespace tinwright::tools

#endif
