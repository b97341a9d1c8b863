"""Where does the gait end from other phases than those of the start, and what does a push do?

``python -m research.basin`` walks from phases by chance and from every gait with a name;
``python -m research.basin.pushes`` pushes a robot that walks.
"""
