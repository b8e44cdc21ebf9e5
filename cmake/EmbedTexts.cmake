# Writes OUTPUT, a C++ source that defines footprint::SYMBOL: the texts of INPUTS (joined by "|") by file name.
string(REPLACE "|" ";" inputs "${INPUTS}")
foreach(input IN LISTS inputs)
  get_filename_component(name "${input}" NAME)
  file(READ "${input}" text)
  list(APPEND names "${name}")
  set("text_${name}" "${text}")
endforeach()
list(SORT names)
# A page's script is longer than the 65536 characters of a literal that every compiler must take; GCC and Clang take more.
set(source "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n"
           "#include \"renderer/core/embedded_texts.hpp\"\n"
           "namespace footprint {\nnamespace {\nconstexpr EmbeddedText ${SYMBOL}_files[] = {\n")
string(CONCAT source ${source})
foreach(name IN LISTS names)
  string(APPEND source "{\"${name}\", R\"embedded(${text_${name}})embedded\"},\n")
endforeach()
string(APPEND source "};\n}\nextern const EmbeddedTexts ${SYMBOL};\n"
                     "constinit const EmbeddedTexts ${SYMBOL}{${SYMBOL}_files};\n}\n")
file(WRITE "${OUTPUT}.new" "${source}")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
