# Writes the values that anova_test.cpp compares with: R's afex on ten data sets, which both make by the same arithmetic.
#
#   Rscript anova_reference.R > anova_reference.inc      (Debian: r-base-core r-cran-afex)
suppressMessages(library(afex))

# The shapes of the data: levels of factors within, the group of each subject for each factor between, missing cells as
# pairs of subject and cell, counted from 1.
sets <- list(
  list(within = c(A = 3), subjects = 10),
  list(within = c(A = 2, B = 3), subjects = 12),
  list(within = c(A = 4), subjects = 8, missing = list(c(2, 3), c(7, 1))),
  list(within = c(A = 2, B = 2, C = 3), subjects = 9),
  list(within = c(A = 3), subjects = 12, between = list(G = rep(1:2, 6))),
  list(within = c(A = 2, B = 3), subjects = 16, between = list(G = rep(1:3, c(4, 5, 7)))),
  list(within = c(A = 3), subjects = 20, between = list(G = rep(1:2, 10), H = rep(1:2, each = 10)),
       missing = list(c(4, 2), c(5, 1), c(11, 3))),
  list(within = c(A = 5), subjects = 15),
  list(within = c(A = 2, B = 6), subjects = 13, missing = list(c(13, 12))),
  list(within = c(A = 2), subjects = 6))

# Park and Miller's generator: its products are exact in double precision.
draws <- function(seed) {
  state <- seed
  function() {
    state <<- (16807 * state) %% 2147483647
    state / 2147483647
  }
}

long_data <- function(number) {
  set <- sets[[number]]
  draw <- draws(1000 + number)
  cells <- prod(set$within)
  rows <- list()
  for (s in seq_len(set$subjects)) {
    subject <- draw()
    group <- sum(vapply(set$between, function(g) g[s] - 1, 0))
    for (c in seq_len(cells) - 1) {
      u <- c(draw(), draw(), draw())
      y <- 20 + 6 * subject + 0.4 * c * (0.5 + u[1]) + 3 * (u[2] + u[3] - 1) * (1 + 0.3 * (c %% 3)) + 1.5 * group * (1 + c / 4)
      if (any(vapply(set$missing, function(m) m[1] == s && m[2] == c + 1, TRUE))) next
      row <- list(id = s, y = y)
      rest <- c
      for (f in rev(names(set$within))) {
        row[[f]] <- rest %% set$within[[f]] + 1
        rest <- rest %/% set$within[[f]]
      }
      for (g in names(set$between)) row[[g]] <- set$between[[g]][s]
      rows[[length(rows) + 1]] <- as.data.frame(row)
    }
  }
  data <- do.call(rbind, rows)
  for (f in setdiff(names(data), "y")) data[[f]] <- factor(data[[f]])
  data
}

value <- function(x) if (length(x) == 0 || is.na(x)) "none" else format(x, digits = 12)

for (number in seq_along(sets)) {
  set <- sets[[number]]
  model <- suppressWarnings(suppressMessages(aov_ez(
    "id", "y", long_data(number), within = names(set$within), between = names(set$between))))
  table <- suppressWarnings(anova(model, es = c("ges", "pes"), correction = "none"))
  whole <- suppressWarnings(summary(model))
  of <- function(part, effect, column) {
    # An effect of one degree of freedom has no sphericity.
    if (is.null(part) || !(effect %in% rownames(part)) || is.na(part[effect, 1])) NA else part[effect, column]
  }
  for (effect in rownames(table)) {
    numbers <- c(table[effect, "num Df"], table[effect, "den Df"], table[effect, "F"], table[effect, "Pr(>F)"],
                 table[effect, "ges"], table[effect, "pes"],
                 of(whole$sphericity.tests, effect, "Test statistic"), of(whole$sphericity.tests, effect, "p-value"),
                 of(whole$pval.adjustments, effect, "GG eps"), of(whole$pval.adjustments, effect, "Pr(>F[GG])"),
                 of(whole$pval.adjustments, effect, "HF eps"), of(whole$pval.adjustments, effect, "Pr(>F[HF])"))
    cat(sprintf("{%d, \"%s\", {%s}},\n", number, effect, paste(vapply(numbers, value, ""), collapse = ", ")))
  }
}
