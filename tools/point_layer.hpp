#ifndef TINWRIGHT_TOOLS_POINT_LAYER_HPP
#define TINWRIGHT_TOOLS_POINT_LAYER_HPP

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/tin_dataset.hpp"
#include "tinwright/io/tin_drivers.hpp"

namespace tinwright::tools {

/// Private to those who write such files: one layer of points, places that people are to look at.
class PointLayer {
  public:
    /// Throws UsageError when no vector driver fits the target; touches nothing. `driver`: empty for the one
    /// of the file's extension.
    static void check_target(const std::string& target, const std::string& driver = "");

    /// Whether points have z.
    enum class Shape { WithZ, Flat };

    /// Creates the file under a temporary name. Throws UsageError, IoError.
    PointLayer(const std::string& target, const std::string& driver, bool overwrite, const std::string& layer,
               std::span<const io::TinField> fields, io::Crs crs, Shape shape = Shape::WithZ,
               const io::TinMetadata& metadata = {});
    ~PointLayer() = default;
    PointLayer(const PointLayer&) = delete;
    PointLayer& operator=(const PointLayer&) = delete;

    /// Sets field `i` of the point that is written next; it keeps its value until set anew.
    template <class Value>
    void set(std::size_t i, const Value& value) {
        layer_.set(i, value);
    }
    /// Sets the field, or empties it.
    template <class Value>
    void set(std::size_t i, const std::optional<Value>& value) {
        if (value) {
            layer_.set(i, *value);
        } else {
            layer_.set_null(i);
        }
    }
    void write(const Point3& location);
    [[nodiscard]] const std::string& driver() const { return driver_.name; }
    /// Finishes the file, which is still under its temporary name; `commit` moves it into place. Throws
    /// IoError.
    std::unique_ptr<io::AtomicOutput> finish();

  private:
    Shape shape_;
    io::TinDriver driver_;
    io::Crs crs_;
    io::WriteTinOptions options_;
    std::unique_ptr<io::AtomicOutput> output_;
    io::TinDataset dataset_;
    io::TinLayer layer_;
};

}  // namespace tinwright::tools

#endif
