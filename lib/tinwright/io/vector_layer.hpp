#ifndef TINWRIGHT_IO_VECTOR_LAYER_HPP
#define TINWRIGHT_IO_VECTOR_LAYER_HPP

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/source.hpp"

class GDALDataset;
class OGRFeature;
class OGRLayer;

namespace tinwright::io {

/// Private to the readers of vector files: the layer that a source asks for, with the source's filter set.
class VectorLayer {
  public:
    /// How a layer is found where the source names none.
    struct Wanted {
        std::function<bool(OGRLayer&)> may_be;  ///< asked when there are several
        std::string nothing;                    ///< "no layer has points"
        std::string several;                    ///< "several layers may have samples"
        std::string hint;                       ///< goes on after "choose one of ... with layer="
    };

    /// The dataset must outlive this object. `file`: as in `file "a.gpkg"`. Throws InputError when there is
    /// no such layer, none or several to choose from, or the filter or statement cannot be used.
    VectorLayer(GDALDataset& dataset, const Source& source, const std::string& file, const Wanted& wanted);
    ~VectorLayer();
    VectorLayer(const VectorLayer&) = delete;
    VectorLayer& operator=(const VectorLayer&) = delete;

    [[nodiscard]] OGRLayer& layer() const { return *layer_; }
    /// `file "a.gpkg", layer "p"`, for messages.
    [[nodiscard]] const std::string& where() const { return where_; }
    [[nodiscard]] std::vector<std::string> field_names() const;
    /// The names of numeric fields, quoted, separated by commas.
    [[nodiscard]] std::string numeric_fields() const;
    /// Position of the field that `key=` names. Throws InputError listing those that there are.
    [[nodiscard]] int field(const char* key, const std::string& name) const;
    /// What z= says: a field's position or a constant; nothing for the geometry's own. Where a field has a
    /// number for its name, the field is meant. Throws InputError.
    struct Elevation {
        int field = -1;
        std::optional<double> constant;
    };
    [[nodiscard]] Elevation elevation(const std::string& z) const;
    /// Throws for what GDAL said while features were read: some drivers look at the filter only then.
    void require_no_error(const GdalMessages& messages, bool any_feature) const;

  private:
    GDALDataset& dataset_;
    const Source& source_;
    OGRLayer* layer_ = nullptr;
    OGRLayer* result_ = nullptr;
    std::string where_;
};

/// Names of a layer's fields, of all or of the numeric ones.
std::vector<std::string> field_names(OGRLayer& layer, bool only_numeric);

/// The number in a field. Returns why not, half a sentence, when there is none; `value` is finite otherwise.
std::string field_number(const OGRFeature& feature, int field, double& value);

/// Leaves out the attributes that are not read. Not for a layer with a filter, which may need them.
void ignore_other_fields(OGRLayer& layer, const std::vector<int>& used);

}  // namespace tinwright::io

#endif
