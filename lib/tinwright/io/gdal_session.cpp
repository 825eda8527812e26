#include "tinwright/io/gdal_session.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <string_view>
#include <vector>

#include <cpl_error.h>
#include <gdal_priv.h>

namespace tinwright::io {

struct GdalMessages::State {
    std::mutex mutex;
    std::string last_error;
    std::string last_warning;
};

namespace {

/// What is alive now: messages of threads that are not ours (GDAL's workers) go to the youngest.
struct Captures {
    std::mutex mutex;
    std::vector<void*> alive;
    CPLErrorHandler replaced = nullptr;
};

Captures& captures() {
    static Captures all;
    return all;
}

std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (blank && (line.empty() || line.back() == ' ')) {
            continue;
        }
        line += blank ? ' ' : c;
    }
    while (!line.empty() && (line.back() == ' ' || line.back() == '.')) {
        line.pop_back();
    }
    return line;
}

}  // namespace

/// GDAL's callbacks; a struct so that they may see the private state.
struct GdalMessageHandler {
    static void keep(GdalMessages::State& state, CPLErr level, const char* message) {
        const std::lock_guard lock(state.mutex);
        if (level == CE_Warning) {
            state.last_warning = message;
        } else {
            state.last_error = message;
        }
    }

    static void CPL_STDCALL on_this_thread(CPLErr level, CPLErrorNum number, const char* message) {
        if (level == CE_Debug) {
            CPLDefaultErrorHandler(level, number, message);
            return;
        }
        keep(*static_cast<GdalMessages::State*>(CPLGetErrorHandlerUserData()), level, message);
    }

    static void CPL_STDCALL on_other_threads(CPLErr level, CPLErrorNum number, const char* message) {
        Captures& all = captures();
        const std::lock_guard lock(all.mutex);
        if (level == CE_Debug || all.alive.empty()) {
            CPLDefaultErrorHandler(level, number, message);
            return;
        }
        keep(*static_cast<GdalMessages::State*>(all.alive.back()), level, message);
    }
};

void register_drivers() {
    static std::once_flag once;
    std::call_once(once, [] {
        GDALAllRegister();
        // Else GDAL takes another system for a deprecated one, on another datum even (EPSG:2192 becomes
        // EPSG:2154).
        if (CPLGetConfigOption("OSR_USE_NON_DEPRECATED", nullptr) == nullptr) {
            CPLSetConfigOption("OSR_USE_NON_DEPRECATED", "NO");
        }
    });
}

GdalMessages::GdalMessages() : state_(new State) {
    Captures& all = captures();
    {
        const std::lock_guard lock(all.mutex);
        all.alive.push_back(state_);
        if (all.alive.size() == 1) {
            all.replaced = CPLSetErrorHandler(&GdalMessageHandler::on_other_threads);
        }
    }
    CPLPushErrorHandlerEx(&GdalMessageHandler::on_this_thread, state_);
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
    Captures& all = captures();
    {
        const std::lock_guard lock(all.mutex);
        std::erase(all.alive, static_cast<void*>(state_));
        if (all.alive.empty()) {
            CPLSetErrorHandler(all.replaced);
        }
    }
    delete state_;
}

std::string GdalMessages::last_error() const {
    const std::lock_guard lock(state_->mutex);
    return one_line(state_->last_error);
}

std::string GdalMessages::last_warning() const {
    const std::lock_guard lock(state_->mutex);
    return one_line(state_->last_warning);
}

std::string GdalMessages::suffix() const {
    const std::string text = last_error();
    return text.empty() ? text : "; GDAL says: " + text;
}

namespace {

/// Bytes of the well-formed UTF-8 sequence at `i`, 0 when there is none (Unicode 15, Table 3-7).
std::size_t utf8_length(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) {
        return k < text.size() ? static_cast<unsigned char>(text[k]) : static_cast<unsigned char>(0);
    };
    const unsigned lead = byte(i);
    if (lead < 0x80) {
        return 1;
    }
    const std::size_t length = lead >= 0xC2 && lead <= 0xDF   ? 2
                               : lead >= 0xE0 && lead <= 0xEF ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    unsigned low = 0x80;
    unsigned high = 0xBF;
    if (lead == 0xE0) {
        low = 0xA0;
    } else if (lead == 0xED) {
        high = 0x9F;  // no surrogates
    } else if (lead == 0xF0) {
        low = 0x90;
    } else if (lead == 0xF4) {
        high = 0x8F;
    }
    for (std::size_t k = 1; k < length; ++k) {
        const unsigned next = byte(i + k);
        if (next < low || next > high) {
            return 0;
        }
        low = 0x80;
        high = 0xBF;
    }
    return length;
}

/// C1 controls are control characters too, though well-formed.
bool is_c1_control(std::string_view piece) {
    return piece.size() == 2 && piece[0] == '\xC2' && static_cast<unsigned char>(piece[1]) < 0xA0;
}

std::string escaped(char c) {
    switch (c) {
        case '\n':
            return "\\n";
        case '\r':
            return "\\r";
        case '\t':
            return "\\t";
        case '"':
            return "\\\"";
        case '\\':
            return "\\\\";
        default:
            break;
    }
    constexpr std::string_view kHex = "0123456789abcdef";
    const auto value = static_cast<unsigned char>(c);
    return {'\\', 'x', kHex[value >> 4U], kHex[value & 15U]};
}

}  // namespace

std::string quoted(const std::string& text) {
    std::vector<std::string> pieces;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text, i);
        const char c = text[i];
        if (length > 1 && !is_c1_control(std::string_view(text).substr(i, length))) {
            pieces.push_back(text.substr(i, length));
            i += length;
            continue;
        }
        const auto value = static_cast<unsigned char>(c);
        const bool plain = value >= 0x20 && value < 0x7F && c != '"' && c != '\\';
        pieces.push_back(plain ? std::string(1, c) : escaped(c));
        ++i;
    }
    constexpr std::size_t kLongest = 200;  // characters; a path longer than this is known by its ends
    constexpr std::size_t kKept = 96;
    std::string out = "\"";
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (pieces.size() > kLongest && i == kKept) {
            out += "...";
            i = pieces.size() - kKept;
        }
        out += pieces[i];
    }
    return out + "\"";
}

std::string quoted_list(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 20;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
        list += (i == 0 ? "" : ", ") + quoted(names[i]);
    }
    return names.size() > kMost ? list + ", ..." : list;
}

}  // namespace tinwright::io
