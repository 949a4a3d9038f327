# Who answers for the packages: WHEATSTONE_MAINTAINER, or else DEBFULLNAME and DEBEMAIL, as Debian's own tools read them.
# The placeholder is for packages that stay with whoever makes them: scripts/check-packages refuses it.
set(placeholder "Wheatstone authors <wheatstone@example.org>")
set(WHEATSTONE_MAINTAINER "${placeholder}" CACHE STRING "Who answers for the packages: Name <mail>")

if(WHEATSTONE_MAINTAINER STREQUAL placeholder)
  set(name "$ENV{DEBFULLNAME}")
  set(mail "$ENV{DEBEMAIL}")
  if(mail MATCHES "^(.+) <(.+)>$")
    set(mail "${CMAKE_MATCH_2}")
    if(NOT name)
      set(name "${CMAKE_MATCH_1}")
    endif()
  endif()
  if(name AND mail)
    set(WHEATSTONE_MAINTAINER "${name} <${mail}>")
  endif()
endif()

if(NOT WHEATSTONE_MAINTAINER MATCHES "^[^<>]+ <[^<>@ ]+@[^<>@ ]+>$")
  message(FATAL_ERROR "WHEATSTONE_MAINTAINER is \"${WHEATSTONE_MAINTAINER}\", expected \"Name <mail>\"")
endif()
