#include "tinwright/io/vector_arrow.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include <cpl_string.h>
#include <ogr_recordbatch.h>
#include <ogrsf_frmts.h>

#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

/// A structure of the Arrow C interface, which knows how to release itself.
template <class Arrow>
struct Released : Arrow {
    Released() : Arrow() {}
    Released(const Released&) = delete;
    Released& operator=(const Released&) = delete;
    ~Released() {
        if (this->release != nullptr) {
            this->release(this);
        }
    }
};

using Stream = Released<ArrowArrayStream>;
using Schema = Released<ArrowSchema>;
using Batch = Released<ArrowArray>;

/// Where the columns that we read are among the stream's children, -1 for none.
struct Columns {
    int id = -1;
    int geometry = -1;
    int z = -1;
    char geometry_format = 'z';  // 'z': 32-bit offsets, 'Z': 64-bit ones
    char z_format = 'g';         // 'g' double, 'f' float, 'l' 64-bit, 'i' 32-bit, 's' 16-bit integer
};

template <typename T>
const T* buffer(const ArrowArray& array, int k) {
    return static_cast<const T*>(array.buffers[k]);
}

bool is_null(const ArrowArray& array, std::int64_t row) {
    const auto* const valid = buffer<std::uint8_t>(array, 0);
    const auto bit = static_cast<std::uint64_t>(array.offset + row);
    return array.null_count != 0 && valid != nullptr && ((valid[bit / 8] >> (bit % 8)) & 1U) == 0;
}

bool is_format(const ArrowSchema& schema, std::string_view formats) {
    return schema.format != nullptr && schema.format[0] != '\0' && schema.format[1] == '\0' &&
           formats.find(schema.format[0]) != std::string_view::npos;
}

/// Keeps only what the plan reads, but one field at least: see read_arrow(). All fields come back when it
/// ends.
class IgnoredFields {
  public:
    explicit IgnoredFields(const VectorPlan& plan) : layer_(*plan.layer) {
        const OGRFeatureDefn& definition = *layer_.GetLayerDefn();
        const int count = definition.GetFieldCount();
        if (plan.has_filter || count < 2 || layer_.TestCapability(OLCIgnoreFields) == 0) {
            return;
        }
        const int kept = plan.z_field >= 0 ? plan.z_field : cheapest(definition);
        CPLStringList ignored;
        for (int i = 0; i < count; ++i) {
            if (i != kept) {
                ignored.AddString(definition.GetFieldDefn(i)->GetNameRef());
            }
        }
        is_active_ = layer_.SetIgnoredFields(const_cast<const char**>(ignored.List())) == OGRERR_NONE;
    }
    IgnoredFields(const IgnoredFields&) = delete;
    IgnoredFields& operator=(const IgnoredFields&) = delete;
    ~IgnoredFields() {
        if (is_active_) {
            layer_.SetIgnoredFields(nullptr);
        }
    }

  private:
    static int cheapest(const OGRFeatureDefn& definition) {
        for (int i = 0; i < definition.GetFieldCount(); ++i) {
            const OGRFieldType type = definition.GetFieldDefn(i)->GetType();
            if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) {
                return i;
            }
        }
        return 0;
    }

    OGRLayer& layer_;
    bool is_active_ = false;
};

std::uint32_t little_endian_32(const unsigned char* bytes) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// One layer's stream on its way into samples.
class ArrowReader {
  public:
    ArrowReader(const VectorPlan& plan, const SliceRequest& request, std::vector<Point3>& points,
                RawSlice& slice)
        : plan_(plan), request_(request), points_(points), samples_(plan, points, slice) {}

    bool read() {
        const GdalMessages messages;
        const IgnoredFields ignored(plan_);
        total_ = plan_.layer->GetFeatureCount();
        if (total_ > 0) {
            points_.reserve(points_.size() + static_cast<std::size_t>(total_));
        }
        CPLStringList options;
        options.SetNameValue("INCLUDE_FID", "YES");
        // Batches small enough that their memory is used again rather than mapped anew.
        options.SetNameValue("MAX_FEATURES_IN_BATCH", "8192");
        Stream stream;
        if (!plan_.layer->GetArrowStream(&stream, options.List()) || !find_columns(stream)) {
            return false;
        }
        std::int64_t rows = 0;
        while (true) {
            Batch batch;
            if (stream.get_next(&stream, &batch) != 0) {
                return false;
            }
            if (batch.release == nullptr) {
                break;
            }
            if (!read_batch(batch)) {
                return false;
            }
            rows += batch.length;
            report_progress(
                request_.progress,
                total_ > 0 ? std::min(1.0, static_cast<double>(rows) / static_cast<double>(total_)) : 0.5);
        }
        return rows == total_ && messages.last_error().empty();
    }

  private:
    bool find_columns(Stream& stream) {
        Schema schema;
        if (stream.get_schema(&stream, &schema) != 0) {
            return false;
        }
        const OGRFeatureDefn& definition = *plan_.layer->GetLayerDefn();
        const auto name_or = [](const char* name, const char* fallback) {
            return std::string_view(name == nullptr || name[0] == '\0' ? fallback : name);
        };
        const std::string_view id = name_or(plan_.layer->GetFIDColumn(), "OGC_FID");
        const std::string_view geometry =
            name_or(definition.GetGeomFieldDefn(0)->GetNameRef(), "wkb_geometry");
        for (std::int64_t c = 0; c < schema.n_children; ++c) {
            const ArrowSchema& child = *schema.children[c];
            const std::string_view name = name_or(child.name, "");
            if (name == id && is_format(child, "l")) {
                columns_.id = static_cast<int>(c);
            } else if (name == geometry && is_format(child, "zZ")) {
                columns_.geometry = static_cast<int>(c);
                columns_.geometry_format = child.format[0];
            } else if (plan_.z_field >= 0 && name == definition.GetFieldDefn(plan_.z_field)->GetNameRef() &&
                       is_format(child, "gflis")) {
                columns_.z = static_cast<int>(c);
                columns_.z_format = child.format[0];
            }
        }
        return columns_.id >= 0 && columns_.geometry >= 0 && (plan_.z_field < 0 || columns_.z >= 0);
    }

    bool read_batch(const ArrowArray& batch) {
        const ArrowArray& ids = *batch.children[columns_.id];
        const ArrowArray& geometries = *batch.children[columns_.geometry];
        const auto* const id = buffer<std::int64_t>(ids, 1) + ids.offset;
        const auto* const bytes = buffer<unsigned char>(geometries, 2);
        for (std::int64_t row = 0; row < batch.length; ++row) {
            const auto [begin, end] = extent(geometries, row);
            if (begin >= end || is_null(geometries, row) || is_null(ids, row)) {
                return false;
            }
            std::optional<double> z = plan_.z_constant;
            if (columns_.z >= 0) {
                const ArrowArray& values = *batch.children[columns_.z];
                if (is_null(values, row)) {
                    return false;  // read_features() says which field of which feature
                }
                z = number(values, row);
            }
            read_geometry(bytes + begin, static_cast<std::size_t>(end - begin), z, id[row]);
        }
        return true;
    }

    [[nodiscard]] std::pair<std::int64_t, std::int64_t> extent(const ArrowArray& array,
                                                               std::int64_t row) const {
        if (columns_.geometry_format == 'Z') {
            const auto* const offset = buffer<std::int64_t>(array, 1) + array.offset + row;
            return {offset[0], offset[1]};
        }
        const auto* const offset = buffer<std::int32_t>(array, 1) + array.offset + row;
        return {offset[0], offset[1]};
    }

    [[nodiscard]] double number(const ArrowArray& array, std::int64_t row) const {
        const std::int64_t i = array.offset + row;
        switch (columns_.z_format) {
            case 'f':
                return static_cast<double>(buffer<float>(array, 1)[i]);
            case 'l':
                return static_cast<double>(buffer<std::int64_t>(array, 1)[i]);
            case 'i':
                return buffer<std::int32_t>(array, 1)[i];
            case 's':
                return buffer<std::int16_t>(array, 1)[i];
            default:
                return buffer<double>(array, 1)[i];
        }
    }

    /// Plain little-endian points here, everything else by GDAL.
    void read_geometry(const unsigned char* wkb, std::size_t size, std::optional<double> z, std::int64_t id) {
        constexpr std::size_t kSize2d = 5 + 2 * sizeof(double);
        constexpr std::size_t kSize3d = 5 + 3 * sizeof(double);
        if constexpr (std::endian::native == std::endian::little) {
            if (size >= kSize2d && wkb[0] == 1) {
                const std::uint32_t type = little_endian_32(wkb + 1);
                const bool is_3d = (type == 0x80000001U || type == 1001U) && size == kSize3d;
                const bool is_2d = type == 1U && size == kSize2d && z;
                if (is_3d || is_2d) {
                    Point3 sample;
                    std::memcpy(&sample, wkb + 5, is_3d ? kSize3d - 5 : kSize2d - 5);
                    sample.z = z.value_or(sample.z);
                    if (std::isfinite(sample.x) && std::isfinite(sample.y) && std::isfinite(sample.z)) {
                        samples_.add(sample, id);
                        return;
                    }
                }
            }
        }
        OGRGeometry* made = nullptr;
        OGRGeometryFactory::createFromWkb(wkb, nullptr, &made, size);
        const std::unique_ptr<OGRGeometry> geometry(made);
        samples_.add(geometry.get(), z, id);
    }

    const VectorPlan& plan_;
    const SliceRequest& request_;
    std::vector<Point3>& points_;
    FeatureSamples samples_;
    Columns columns_;
    std::int64_t total_ = 0;
};

}  // namespace

bool read_arrow(const VectorPlan& plan, const SliceRequest& request, std::vector<Point3>& points,
                RawSlice& slice) {
    const OGRFeatureDefn& definition = *plan.layer->GetLayerDefn();
    if (plan.x_field >= 0 || definition.GetGeomFieldCount() != 1 ||
        plan.layer->TestCapability(OLCFastGetArrowStream) == 0) {
        return false;
    }
    const std::size_t before = points.size();
    const RawSlice untouched = slice;
    if (ArrowReader(plan, request, points, slice).read()) {
        return true;
    }
    points.resize(before);
    slice = untouched;
    return false;
}

}  // namespace tinwright::io
