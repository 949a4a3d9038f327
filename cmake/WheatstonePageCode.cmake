# Writes the code and the style sheet of shared pages as C++, with the hashes that a Content-Security-Policy names.
#
#   cmake -DCODE=page.js -DSTYLE=page.css -DTO=page_code.cpp -P WheatstonePageCode.cmake
set(text "#include \"wheatstone/share/page_code_internal.h\"\n\nnamespace wheatstone {\n\n")
foreach(name CODE STYLE)
  string(TOLOWER ${name} lower)
  file(READ ${${name}} contents)
  file(SHA256 ${${name}} hash)
  string(APPEND text
    "const PageText page_${lower}{R\"~page~(${contents})~page~\",\n  \"${hash}\"};\n\n")
endforeach()
file(WRITE ${TO} "${text}}  // namespace wheatstone\n")
