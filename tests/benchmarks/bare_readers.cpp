#include "benchmarks/bare_readers.hpp"

#include <charconv>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <ogr_recordbatch.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

namespace tinwright_benchmarks {

using tinwright::Point3;

std::vector<Point3> read_text_barely(const std::string& path) {
    const auto size = static_cast<std::size_t>(std::filesystem::file_size(path));
    const std::unique_ptr<char[]> text(new char[size]);
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    std::size_t filled = 0;
    while (filled < size) {
        const ssize_t got = read(file, text.get() + filled, size - filled);
        if (got <= 0) {
            throw std::runtime_error("cannot read " + path);
        }
        filled += static_cast<std::size_t>(got);
    }
    close(file);
    std::vector<Point3> points;
    points.reserve(size / std::strlen("0 0 0\n"));  // costs nothing until it is filled
    const char* at = text.get();
    const char* const end = at + size;
    while (at < end) {
        Point3 p;
        at = std::from_chars(at, end, p.x).ptr + 1;
        at = std::from_chars(at, end, p.y).ptr + 1;
        at = std::from_chars(at, end, p.z).ptr + 1;
        points.push_back(p);
    }
    return points;
}

std::vector<Point3> read_arrow_barely(const std::string& path) {
    const std::unique_ptr<GDALDataset> dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
    OGRLayer* const layer = dataset ? dataset->GetLayer(0) : nullptr;
    ArrowArrayStream stream{};
    if (layer == nullptr || !layer->GetArrowStream(&stream, nullptr)) {
        throw std::runtime_error("cannot read " + path);
    }
    std::vector<Point3> points;
    points.reserve(static_cast<std::size_t>(layer->GetFeatureCount()));
    for (ArrowArray batch{}; stream.get_next(&stream, &batch) == 0 && batch.release != nullptr;
         batch.release(&batch)) {
        const ArrowArray& geometries = *batch.children[batch.n_children - 1];  // the last column
        const auto* const offsets = static_cast<const std::int32_t*>(geometries.buffers[1]);
        const auto* const bytes = static_cast<const unsigned char*>(geometries.buffers[2]);
        for (std::int64_t row = 0; row < batch.length; ++row) {
            constexpr int kHead = 5;  // byte order and type
            Point3 p;
            std::memcpy(&p, bytes + offsets[row] + kHead, sizeof p);
            points.push_back(p);
        }
    }
    stream.release(&stream);
    return points;
}

}  // namespace tinwright_benchmarks
