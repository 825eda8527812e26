#ifndef TINWRIGHT_TOOLS_GDAL_SPELLINGS_HPP
#define TINWRIGHT_TOOLS_GDAL_SPELLINGS_HPP

#include <string>
#include <vector>

namespace tinwright::tools {

/// Rewrites what GDAL's users type so that an ordinary parser reads it: the exact tokens `-of`, `-co`, `-te`,
/// `-tr`, `-ts`, `-tap`, `-a_srs`, `-a_nodata`, `-oo`, `-lco`, `-ot`, `-nln` and `-overwrite` become the long
/// options they stand for; the second number of a resolution joins the first ("5 2" becomes "5,2"), because
/// only a number may follow there; and "-.5" becomes "-0.5". Tokens after `--` are left alone.
std::vector<std::string> rewrite_gdal_spellings(const std::vector<std::string>& arguments);

}  // namespace tinwright::tools

#endif
