#ifndef TINWRIGHT_OPTIMAL_CERTIFICATE_HPP
#define TINWRIGHT_OPTIMAL_CERTIFICATE_HPP

#include <cstddef>
#include <optional>
#include <vector>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"

/// Proving again, slowly and by other means than the engine's, that a TIN is optimal.
namespace tinwright {

struct CertificateOptions {
    Criterion criterion = Criterion::Slope;  ///< one of kInsertionCriteria, or see below
    std::optional<std::size_t> faces = 100;  ///< how many of the worst to examine; empty: all
    bool until_improvable = false;           ///< no more once one is found that can be improved
    /// Edges that cross more faces than this are not tried; empty: all edges are.
    std::optional<std::size_t> reach;
    Progress progress;  ///< throws Cancelled when it says stop
};

/// An edge whose insertion would improve a face.
struct Improvement {
    FaceId face{};
    VertexId anchor{};
    VertexId apex{};     ///< the other end of the edge
    double measure = 0;  ///< of the face, in the criterion's unit
    double improved =
        0;  ///< the worst of the faces that would replace it and all others that the edge crosses
};

struct Certificate {
    std::size_t faces = 0;       ///< examined
    std::size_t anchorless = 0;  ///< of these, faces without an anchor, for which there is nothing to try
    std::size_t edges = 0;       ///< edges tried
    std::size_t cut = 0;         ///< views that go on beyond the reach, where nothing was tried
    WorstMeasures worst;
    std::vector<Improvement> improvements;  ///< worst face first, at most one a face; none: optimal
};

/// Tries, for each of the worst faces, every edge that leaves an anchor of it through the opposite edge and
/// crosses neither constrained edges nor faces that are worse; both sides of the edge are filled by dynamic
/// programming [tan1993, Sec. 2.2]. A face that no such edge improves is in every optimal triangulation, ties
/// apart, by the Cake-Cutting Lemma [tan1993, Sec. 3.3]. An edge that would run through a vertex is none: the
/// one that ends there is tried. Of the edges that improve a face the first found is listed.
///
/// For the criteria of edge insertion. Of length, here in the Euclidean norm, what is listed as improvement
/// is one, but nothing listed proves nothing: `certify_length` knows.
///
/// An improvement counts only if it exceeds the rounding of measures: every new face, taken at the upper end
/// of its error, has to be better than the old one at the lower end of its own.
///
/// `tin`: at least one terrain face.
/// Cost: of a face, the number of vertices in sight times the square of the number of faces that an edge
/// crosses, at worst its cube. Where no worse face blocks the view that is quadratic in the size of the TIN,
/// and linear with a reach. 8 bytes a face of scratch, and 16 times the square of the faces crossed.
Certificate certify(const Tin& tin, const CertificateOptions& options);

}  // namespace tinwright

#endif
