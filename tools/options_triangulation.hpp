#ifndef TINWRIGHT_TOOLS_OPTIONS_TRIANGULATION_HPP
#define TINWRIGHT_TOOLS_OPTIONS_TRIANGULATION_HPP

#include <optional>
#include <string>

#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/water/flat_faces.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// How samples become a TIN.
struct TriangulationOptions {
    std::string criterion_text;  ///< empty: delaunay
    std::string scope_text;
    std::string norm_text;
    std::string budget_text;
    std::string order_text;
    std::string domain_text;  ///< empty: the command's default
    std::string max_edge_text;
    std::string flat_faces_text;
    std::string duplicates_text;
    std::string tolerance_text;
    std::string threads_text;

    // After `finish`:
    std::optional<OptimizeOptions> optimize;             ///< without progress; this
    std::optional<DataDependentOptions> data_dependent;  ///< or this; neither: Delaunay
    DuplicateOptions duplicates;
    DomainRule domain;
    std::optional<double> max_edge;
    FlatFaces flat_faces = FlatFaces::Keep;
    int threads = 0;  ///< 0: all processors

    /// `default_domain` is for the help text.
    void add_to(CLI::App& parser, const std::string& default_domain);
    void add_threads_to(CLI::App& parser);
    /// Reads the texts; what is not given gets the defaults. Throws UsageError.
    void finish(DomainRule::Kind default_domain, DuplicatePolicy default_policy = DuplicatePolicy::Error);
    /// Reads only what is done with samples before they become a TIN, and the number of threads.
    void finish_samples(DuplicatePolicy default_policy = DuplicatePolicy::Error);

    /// The first option given that is about faces, or empty.
    [[nodiscard]] std::string option_for_faces() const;
    /// The first option given that makes no sense for a TIN whose faces already exist, or empty.
    [[nodiscard]] std::string option_for_samples_only() const;

    /// `optimize_progress`: its answer ends the optimising, not the job.
    [[nodiscard]] TriangulateOptions library_options(const Progress& progress,
                                                     const Progress& optimize_progress) const;
    /// Whether the faces are Delaunay but for what flat faces ask for.
    [[nodiscard]] bool is_delaunay() const { return !optimize && !data_dependent; }
    /// "delaunay", "slope", ...
    [[nodiscard]] std::string criterion_name() const;
    /// "l2", "linf", ...; empty for a criterion that measures no edges.
    [[nodiscard]] std::string norm_name() const;
    /// "max", "vector", "top:P%" or "above:VALUE"; empty for a criterion that knows none.
    [[nodiscard]] std::string scope_name() const;
    /// "3", "none"; empty for a criterion that knows none.
    [[nodiscard]] std::string order_name() const;
    /// "convex", "trimmed" or "concave:LENGTH".
    [[nodiscard]] std::string domain_name() const;
    [[nodiscard]] std::string policy_name() const;
    /// The options that affect a TIN's faces, in a fixed order: what outputs record.
    [[nodiscard]] std::string canonical() const;
    /// Those of `finish_samples` among them.
    [[nodiscard]] std::string canonical_samples() const;

  private:
    void finish_criterion();
    void finish_optimum(Criterion criterion);
};

/// The norm of that name, as `--norm` takes it; Euclidean of an empty text. Throws UsageError.
Norm norm_value(const std::string& text);

}  // namespace tinwright::tools

#endif
