// SPDX-License-Identifier: Apache-2.0
#include "film/film_registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_FILMS(PLUGIN) PLUGIN(imageFilm)

LAMPYRIS_REGISTRY(filmRegistry, "film", FilmRegistry, LAMPYRIS_FILMS)
