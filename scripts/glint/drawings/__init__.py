"""Pictures of the pages, from glint's own frames."""
