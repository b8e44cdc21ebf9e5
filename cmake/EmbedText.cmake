# Writes OUTPUT, a C++ source that defines footprint::embedded::SYMBOL with the text of INPUT.
# The text goes in as pieces, because compilers limit the length of one string literal.
file(READ "${INPUT}" hex HEX)
string(LENGTH "${hex}" digits)
math(EXPR size "${digits} / 2")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
string(REGEX REPLACE "((0x..,){32})" "\\1\n" bytes "${bytes}")
file(WRITE "${OUTPUT}.new"
     "#include <string_view>\n"
     "namespace footprint::embedded {\n"
     "namespace {\nconstexpr unsigned char bytes[] = {\n${bytes}0};\n}\n"
     "extern const std::string_view ${SYMBOL};\n"
     "const std::string_view ${SYMBOL}{reinterpret_cast<const char*>(bytes), ${size}};\n"
     "}\n")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
