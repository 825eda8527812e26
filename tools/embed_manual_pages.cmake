# Writes a C++ source with the text of Markdown pages:
#   cmake -DOUTPUT=manual_pages.cpp -DFOLDER=docs/man -DPAGES=a,b -P embed_manual_pages.cmake
string(REPLACE "," ";" PAGES "${PAGES}")
set(entries "")
foreach(page IN LISTS PAGES)
  file(READ "${FOLDER}/${page}.md" text)
  # The title block is for pandoc alone.
  string(REGEX REPLACE "^(%[^\n]*\n)+\n*" "" text "${text}")
  # Marks that a terminal does not show: headings, emphasis, escapes, definitions.
  string(REGEX REPLACE "(^|\n)#+ " "\\1" text "${text}")
  string(REGEX REPLACE "\n:   " "\n    " text "${text}")
  string(REPLACE "*" "" text "${text}")
  string(REPLACE "\\-" "-" text "${text}")
  string(APPEND entries "    ManualPage{\"${page}\", R\"page(${text})page\"},\n")
endforeach()
file(
  WRITE "${OUTPUT}"
  "#include <array>\n\n#include \"manual_pages.hpp\"\n\nnamespace tinwright::tools {\n\nnamespace {\n\n"
  "const std::array kPages{\n${entries}};\n\n}  // namespace\n\n"
  "std::span<const ManualPage> all_manual_pages() { return kPages; }\n\n}  // namespace tinwright::tools\n")
