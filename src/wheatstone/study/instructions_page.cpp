#include "wheatstone/study/instructions_page.h"

#include <fmt/format.h>

#include "wheatstone/files/text_encoding.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone {
namespace {

constexpr std::string_view sheet_style =
    "body{font-family:sans-serif;max-width:40em;margin:2em auto;padding:0 1em;line-height:1.5}"
    "section{page-break-after:always}code{background:#eee;padding:.1em .3em}";

std::string paragraphs(const std::string& text) {
  std::string html = "<p>";
  for (const char letter : html_text(text)) html += letter == '\n' ? "<br>\n" : std::string(1, letter);
  return html + "</p>\n";
}

}  // namespace

std::string instructions_page(const StudyDesign& design, const std::string& folder) {
  const int trials = condition_count(design) * design.repetitions;
  std::string page =
      html_head(design.title, sheet_style) + fmt::format("<section><h1>{}</h1>\n", html_text(design.title));
  page += paragraphs(design.texts.instruction) + paragraphs(design.texts.question);
  if (design.task == StudyTask::rating)
    page += fmt::format("<p>Answer with the keys {} to {}.</p>\n", design.scale_least, design.scale_most);
  else
    page += "<p>Answer with the keys Y for yes and N for no.</p>\n";
  page += fmt::format(
      "<p>There are {} for practice, which do not count, and then {}. You may stop at any time, without giving a "
      "reason.</p></section>\n",
      design.practice, trials);
  page += fmt::format(
      "<section><h1>For the person who runs the study</h1>\n<ol>\n"
      "<li>Test each subject's stereoscopic vision, for example with <code>wheatstone study stimuli --kind "
      "dots</code>.</li>\n"
      "<li>Measure the width of the screen's picture and the distance of the eyes, and choose the screen's mode.</li>\n"
      "<li>For subject 1, 2, … {0}: <code>wheatstone study run {1}/design.toml --subject 1 --screen-width 52cm "
      "--distance 70cm --mode even-odd-rows -o {1}</code></li>\n"
      "<li>Afterwards: <code>wheatstone study analyse {1} --against published -o analysis</code></li>\n</ol>\n"
      "<p>Consent, ethics and what to ask before: see the section on ethics in docs/studies.md.</p></section>\n",
      design.subjects, html_text(folder));
  return page + "</body></html>\n";
}

}  // namespace wheatstone
