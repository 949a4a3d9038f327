// As many views as one run of a program makes: most_gpu_views of views.h.
const int most_views = 64;
